#include "common/web/picture_text.hpp"

#include <fmt/format.h>

namespace priamos {
namespace {

// A page of another origin shows and reads no picture of this camera.
constexpr std::string_view kCommonFields =
    "Cache-Control: no-store\r\nCross-Origin-Resource-Policy: same-origin\r\nX-Content-Type-Options: "
    "nosniff\r\n";

std::string Fields(const WebPicture& picture, Time now) {
  return fmt::format("Content-Type: image/jpeg\r\nContent-Length: {}\r\n{}: {:.3f}\r\n", picture.jpeg->size(),
                     kAgeField, Seconds(now - picture.exposed));
}

}  // namespace

std::string StreamHead() {
  return fmt::format(
      "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n{}Connection: "
      "close\r\n\r\n",
      kCommonFields);
}

std::string PartHead(const WebPicture& picture, Time now) {
  return fmt::format("--picture\r\n{}\r\n", Fields(picture, now));
}

std::string PictureHead(const WebPicture& picture, Duration waited, Time now) {
  return fmt::format("HTTP/1.1 200 OK\r\n{}{}{}: {:.3f}\r\n\r\n", Fields(picture, now), kCommonFields,
                     kWaitField, Seconds(waited));
}

}  // namespace priamos
