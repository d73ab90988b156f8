#include "bus/radio/link_options.hpp"

#include <cmath>

#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {

std::size_t LinkOptions::HeadBytes() const {
  if (instant()) return kDatagramHead;
  return static_cast<std::size_t>(packets() ? std::ceil(Seconds(packet_overhead) * bytes_per_s) : 0);
}

HalfDuplex LinkOptions::Turns(bool onboard) const {
  HalfDuplex turns = half_duplex;
  if (address != 0) {
    turns.rule = onboard ? TurnRule::kPolled : TurnRule::kGranted;
    turns.grace = grace;
  }
  if (packets()) turns.unheard = FromSeconds(static_cast<double>(HeadBytes() + packet_bytes) / bytes_per_s);
  return turns;
}

Duration EchoReach(const LinkOptions& options, std::size_t echo_bytes, std::size_t code_bytes) {
  const double frames = std::ldexp(0.5, static_cast<int>(8 * echo_bytes));
  const std::size_t smallest = FrameOverhead(code_bytes) + 1 + options.HeadBytes();
  return FromSeconds(frames * static_cast<double>(smallest) / options.bytes_per_s);
}

}  // namespace priamos::bus::radio
