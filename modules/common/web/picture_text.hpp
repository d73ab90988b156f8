#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "common/time.hpp"

namespace priamos {

/// The newest picture of a camera that clients of a server look at.
struct WebPicture {
  std::uint64_t number = 0;  ///< counts pictures; 0: there was none yet
  Time exposed{};
  std::shared_ptr<const std::string> jpeg;
};

/// Head of an answer that goes on for ever, one part per picture: MJPEG over HTTP (multipart/x-mixed-replace,
/// RFC 2046).
std::string StreamHead();
/// What stands before a picture of a stream, with its age at `now`. kPartEnd stands behind it.
std::string PartHead(const WebPicture& picture, Time now);
inline constexpr std::string_view kPartEnd = "\r\n";

/// Names of the fields of a head that say how old a picture is [s].
inline constexpr std::string_view kAgeField = "X-Age", kWaitField = "X-Wait";
/// Head of an answer that is one picture: its age at `now`, and how long the request has waited for it. Who
/// asked knows so how old it is at most, whatever his clock says: age, and the time since he asked, without
/// the wait.
std::string PictureHead(const WebPicture& picture, Duration waited, Time now);

}  // namespace priamos
