#include "console/video_feed.hpp"

#include <bit>
#include <cstdint>

namespace priamos::console {

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
