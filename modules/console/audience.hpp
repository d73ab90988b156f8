#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "common/time.hpp"
#include "common/web/web_request.hpp"
#include "common/web/web_server.hpp"
#include "console/core/news.hpp"
#include "console/core/seat.hpp"

namespace priamos::console {

/// The pages that look, and what each of them has been sent.
class Audience {
 public:
  /// What a page is told of the station itself.
  using Station = std::function<nlohmann::ordered_json(ClientId, Role)>;

  void Join(ClientId client, Role role) { pages_[client] = {role, 0, false}; }
  void Leave(ClientId client) { pages_.erase(client); }
  /// Role of a page; that of a viewer when it is not there.
  Role RoleOf(ClientId client) const;
  std::size_t size() const { return pages_.size(); }
  /// From now on every page is greeted anew: what it was sent does not hold any more.
  void StartAgain();

  /// Sends every page `greeting` first, then what is new to it. `now`: the moment from which ages count.
  void Tell(WebServer& server, const std::string& greeting, const News& news, std::int64_t beat, Time now,
            const Station& station);

 private:
  struct Page {
    Role role = Role::kViewer;
    std::uint64_t seen = 0;  ///< number of the news up to which it knows everything
    bool greeted = false;
  };
  std::map<ClientId, Page> pages_;
};

}  // namespace priamos::console
