#include "console/video_feed.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace priamos::console {

PictureAddress CameraOf(PictureAddress server, const std::string& robot,
                        const std::vector<TokenHolder>& holders) {
  server.target = "/" + robot + "/third.jpg";
  if (holders.empty()) return server;
  const auto viewer = std::find_if(holders.begin(), holders.end(),
                                   [](const TokenHolder& holder) { return holder.role == Role::kViewer; });
  server.target += "?token=" + (viewer == holders.end() ? holders.front() : *viewer).token;
  return server;
}

std::string PagePicture(const FetchedPicture& picture, Time now) {
  const auto age = std::bit_cast<std::uint64_t>(Seconds(now - picture.exposed));
  std::string message;
  message.reserve(8 + picture.jpeg.size());
  for (int shift = 56; shift >= 0; shift -= 8) message += static_cast<char>(age >> shift & 0xff);
  return message + picture.jpeg;
}

void VideoFeed::Wish(ClientId client, bool on) {
  if (on)
    pages_.insert(client);
  else
    pages_.erase(client);
}

void VideoFeed::Tick(WebServer& server, FoxgloveBridge& bridge, Time now) {
  client_.Poll(!pages_.empty() || bridge.IsVideoWanted(), now);
  const auto picture = client_.Take();
  if (!picture) return;
  // Who has not taken the one before is sent the next one.
  for (const ClientId page : pages_) server.Send(page, PagePicture(*picture, now), true);
  bridge.ShowVideo(picture->jpeg, picture->exposed);
}

}  // namespace priamos::console
