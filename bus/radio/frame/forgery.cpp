#include "bus/radio/frame/forgery.hpp"

#include <cmath>
#include <numbers>

#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {

double TriesPerSecond(double bytes_per_s, std::size_t code_bytes) {
  return bytes_per_s / static_cast<double>(FrameOverhead(code_bytes));
}

double ForgerySeconds(double bytes_per_s, std::size_t code_bytes) {
  // Of n tries with the small probability p each, none succeeds with (1 - p)^n = exp(-n p).
  const double codes = std::ldexp(1.0, static_cast<int>(8 * code_bytes));
  return std::numbers::ln2 * codes / TriesPerSecond(bytes_per_s, code_bytes);
}

std::size_t DefaultCodeBytes(double bytes_per_s) {
  for (const std::size_t bytes : {kShortCodeBytes, std::size_t{6}})
    if (ForgerySeconds(bytes_per_s, bytes) >= kLeastForgery_s) return bytes;
  return 8;
}

}  // namespace priamos::bus::radio
