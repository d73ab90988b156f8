#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/time.hpp"

namespace priamos::console {

/// The newest message of every channel, with the number of the moment it came at: a page that knows
/// everything up to a number gets what is newer. So a slow page skips messages instead of piling them up.
class News {
 public:
  using Json = nlohmann::ordered_json;

  /// The newest message of one key.
  struct Item {
    std::string key;  ///< channel, and what else distinguishes messages that do not replace each other
    std::string channel;
    Time valid;  ///< moment the message speaks of
    Json message;
    std::string type;  ///< full name of the message's type
    std::uint64_t number = 0;
  };

  /// Most keys that are kept, whatever anybody sends; later ones are not taken.
  static constexpr std::size_t kMostKeys = 1024;

  void Put(const std::string& key, const std::string& channel, Time valid, Json message,
           std::string type = "");
  std::uint64_t newest() const { return newest_; }
  /// Items that came after `number`, oldest first.
  std::vector<const Item*> Since(std::uint64_t number) const;

 private:
  std::map<std::string, Item> items_;
  std::uint64_t newest_ = 0;
};

/// What distinguishes messages of a channel that do not replace each other: the process of HEALTH and
/// PROCESS_STATE, the name in PROCESS_REPORT, the end and part of LINK_STATUS, the landmark of LANDMARK_MODEL
/// and DOOR_SEEN, the door of DOOR_FOUND, the thing of SCENE_OBJECT, the part of FLOOR_MAP; of ALARM and
/// ALARM_ACK the last kKeptAlarms are kept. `count`: messages of the channel so far.
std::string KeyOf(const std::string& channel, const News::Json& message, std::uint64_t count);

}  // namespace priamos::console
