#include "bus/radio/link_options.hpp"

#include <cmath>

#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {

Duration EchoReach(const LinkOptions& options, std::size_t echo_bytes, std::size_t code_bytes) {
  const double frames = std::ldexp(0.5, static_cast<int>(8 * echo_bytes));
  const std::size_t smallest = FrameOverhead(code_bytes) + 1 + (options.datagrams ? kDatagramHead : 0);
  return FromSeconds(frames * static_cast<double>(smallest) / options.bytes_per_s);
}

}  // namespace priamos::bus::radio
