// Which values of a link.toml contradict each other, and which have no effect.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "bus/radio/link_config.hpp"
#include "common/archive.hpp"

namespace priamos::bus::radio {

void LinkConfig::RefuseContradictions(Archive& a) const {
  const double longest_bytes = max_bundle_bytes + 1 + static_cast<double>(FrameOverhead(CodeBytes())) +
                               packet_overhead_s * BytesPerSecond();
  const double shortest_turn_s = 2 * longest_bytes / BytesPerSecond();
  if (half_duplex_turn_s > 0 && half_duplex_turn_s < shortest_turn_s)
    a.Refuse("half_duplex_turn_s", fmt::format("0, or time for at least two frames of max_bundle_bytes, {} s",
                                               std::ceil(1000 * shortest_turn_s) / 1000));
  if (medium == "packet" && packet_overhead_s <= 0)
    a.Refuse("packet_overhead_s", "more than 0 with medium \"packet\"");
  if (medium == "packet" && datagrams)
    a.Refuse("datagrams", "false: with medium \"packet\" a frame goes whole in any case");
  if (medium != "packet" && packet_overhead_s > 0)
    a.Refuse("packet_overhead_s", "0, other than with medium \"packet\"");
  if (medium != "packet" && duty_cycle < 1) a.Refuse("duty_cycle", "1, other than with medium \"packet\"");
  if (half_duplex_turn_s > 0 && duty_cycle < 1)
    a.Refuse("duty_cycle", "1 with half_duplex_turn_s: ends that take turns are always on the air");
  if (robots == 0 && max_bundle_bytes < 30) a.Refuse("max_bundle_bytes", "30 or more on a link of two ends");
  if (robots > 0 && (datagrams || medium == "packet"))
    a.Refuse("robots", "0 with datagrams or packets: robots share a radio channel of bytes");
  if (robots > 0 && half_duplex_turn_s > 0)
    a.Refuse("half_duplex_turn_s", "0 with robots: each turn is one frame of max_bundle_bytes");
  if (silence_s <= keep_alive_s) a.Refuse("silence_s", "more than keep_alive_s");
  RefuseFreshness();
}

/// Turns, packets and datagrams, which cannot be made shorter, would decide how old a state gets.
void LinkConfig::RefuseFreshness() const {
  const bool line = half_duplex_turn_s <= 0 && robots == 0 && medium == "bytes" && !datagrams;
  const LinkChannelConfig* first[2]{};
  for (const LinkChannelConfig& c : channels) {
    if (c.fresh_s <= 0) continue;
    const LinkChannelConfig*& before = first[c.direction == "up"];
    if (!line)
      throw ConfigError(fmt::format("{}: expected 0, other than on a line of two directions, got {:.6g}",
                                    c.place.Of("fresh_s"), c.fresh_s));
    if (before != nullptr)
      throw ConfigError(
          fmt::format("{}: expected 0 beside {}, the one channel of this direction with a bound, got {:.6g}",
                      c.place.Of("fresh_s"), before->name, c.fresh_s));
    before = &c;
  }
}

/// A key that changes nothing makes somebody believe what is not so.
void LinkConfig::RefuseWithoutEffect(Archive& a) const {
  const LinkConfig usual;
  if (medium != "packet" && mtu_bytes != usual.mtu_bytes)
    a.Refuse("mtu_bytes", "none, other than with medium \"packet\": nothing else has packets");
  if (duty_cycle >= 1 && duty_window_s != usual.duty_window_s)
    a.Refuse("duty_window_s", "none without a duty_cycle below 1");
  if (robots == 0 && grace_s != usual.grace_s)
    a.Refuse("grace_s", "none without robots: no end of a link of two is polled");
  if (robots == 0 && half_duplex_turn_s <= 0 && turnaround_s != usual.turnaround_s)
    a.Refuse("turnaround_s", "none without half_duplex_turn_s or robots: nobody takes turns");
  if (air_rate_bytes_s > baud / 10.0)
    a.Refuse("air_rate_bytes_s", "0, or at most the rate of the port, a tenth of baud");
  if (!simulation_key && (key_file.empty() || key_file.find('\0') != std::string::npos))
    a.Refuse("key_file", "the name of a key, made by `priamos link keygen`");
  if (simulation_key && key_file != usual.key_file)
    a.Refuse("key_file", "none beside simulation_key = true, with which no key is read");
  if (ahead_bytes != usual.ahead_bytes && ahead_bytes < Options().ahead_bytes)
    a.Refuse("ahead_bytes",
             fmt::format("at least {} at this rate, which go in {} s between two looks of the process",
                         Options().ahead_bytes, kFeedGap_s));
}

}  // namespace priamos::bus::radio
