#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/time.hpp"
#include "common/web/picture_client.hpp"
#include "common/web/web_request.hpp"
#include "common/web/web_server.hpp"
#include "console/core/seat.hpp"
#include "console/foxglove_bridge.hpp"

namespace priamos::console {

/// Pictures of the robot's third camera on their way to whoever looks. They come over a video link beside bus
/// and radio, while somebody looks, and once however many do.
class VideoFeed {
 public:
  /// What a page listens to that wants them.
  static constexpr std::string_view kChannel = "VIDEO";

  explicit VideoFeed(PictureAddress camera) : client_(std::move(camera)) {}

  void Wish(ClientId client, bool on);
  void Leave(ClientId client) { pages_.erase(client); }
  /// Fetches, and shows what came.
  void Tick(WebServer& server, FoxgloveBridge& bridge, Time now);
  /// Why nothing comes; empty: it comes, or nobody looks.
  const std::string& problem() const { return client_.problem(); }

 private:
  PictureClient client_;
  std::set<ClientId> pages_;
};

/// Where the pictures of a robot's third camera are: its name is in the address, so that another robot's are
/// not shown as its own. `server`: without a target. `holders`: who may fetch them, by token; none: anybody.
/// Of these the token that may do least is taken, which is enough to look.
PictureAddress CameraOf(PictureAddress server, const std::string& robot,
                        const std::vector<TokenHolder>& holders);

/// A picture as a page gets it: 8 bytes, how old it is at `now` [s] as a double with the highest byte first,
/// and the JPEG.
std::string PagePicture(const FetchedPicture& picture, Time now);

}  // namespace priamos::console
