#pragma once

#include <cstddef>

namespace priamos::bus::radio {

/// Frames per second whose codes a receiver checks, on a line that carries so many bytes per second: the
/// shortest frames that fit. What comes faster is not looked at.
double TriesPerSecond(double bytes_per_s, std::size_t code_bytes);

/// Time [s] for which somebody must fill the line with forged frames until one of them has been accepted with
/// a probability of one half.
double ForgerySeconds(double bytes_per_s, std::size_t code_bytes);

/// The least that ForgerySeconds is with the code that a link has by default: 180 days.
inline constexpr double kLeastForgery_s = 180 * 86400.0;

/// Bytes of the shortest code, 4, 6 or 8, with which ForgerySeconds is at least kLeastForgery_s; 8 if none is
/// long enough. 4 up to 1300 bytes per second.
std::size_t DefaultCodeBytes(double bytes_per_s);

}  // namespace priamos::bus::radio
