#include "bus/radio/budget.hpp"
#include "figures.hpp"
#include "test/bus/radio/packet/packet_world.hpp"

// Radios that send packets: every message timed beside its bound, and what comes where packets are lost.

namespace priamos::bench {
namespace {

using namespace bus::radio;

std::vector<double> LatenciesOf(const PacketWorld& world, std::size_t channel) {
  std::vector<double> seconds;
  for (const Duration d : world.latencies.at(channel)) seconds.push_back(Seconds(d));
  return seconds;
}

std::size_t Sum(const std::map<std::size_t, std::size_t>& counts) {
  std::size_t sum = 0;
  for (const auto& [channel, count] : counts) sum += count;
  return sum;
}

/// Longest latency as a share of the budget's bound, over all channels.
double LargestShareOfBound(const PacketWorld& world, const PacketRadio& radio) {
  const Budget budget = ComputeBudget(ChannelTable(world.channels(), false), radio.options);
  double largest = 0;
  for (const DirectionBudget* d : {&budget.up, &budget.down})
    for (const ChannelBudget& row : d->channels)
      largest = std::max(largest,
                         Quantile(LatenciesOf(world, row.channel), 1) / Seconds(row.worst_latency.value()));
  return largest;
}

void NoteLatency(Figures& figures, const PacketWorld& world, std::size_t channel, const std::string& what) {
  const std::vector<double> s = LatenciesOf(world, channel);
  figures.Note("  " + what + ", median", Quantile(s, 0.5), "s");
  figures.Note("  " + what + ", longest", Quantile(s, 1), "s");
}

void WithoutLoss(Figures& figures, const PacketRadio& radio, const Effort& effort) {
  PacketWorld world(radio, 0, effort.seed);
  world.Run(20, false);
  world.Run(radio.hours * 3600 * (effort.long_run ? 5 : 1), true);
  world.Run(60, false);
  figures.Exactly(radio.name + ": messages that came, of those offered",
                  static_cast<double>(Sum(world.offered)), static_cast<double>(Sum(world.received)), "");
  figures.AtMost("  longest latency, of its bound", 1, LargestShareOfBound(world, radio), "");
  NoteLatency(figures, world, kStopDown, "stop");
  NoteLatency(figures, world, kPoseUp, "pose");
  NoteLatency(figures, world, kDriveDown, "drive command");
  if (radio.options.duty.limited())
    figures.AtMost("  largest share of 600 s on the air", 0.1, world.LargestShare(FromSeconds(600)), "");
}

void WithLoss(Figures& figures, const PacketRadio& radio, const Effort& effort) {
  PacketWorld world(radio, 0.2, effort.seed);
  world.Run(60 * radio.unit_s * (effort.long_run ? 10 : 1), true);
  world.Run(300, false);
  for (const std::size_t channel : {kStopDown, kEventDown, kEventUp}) {
    const std::string& name = world.channels()[channel].name;
    figures.Exactly("  one packet in five lost: " + name + " that came, once and in order",
                    static_cast<double>(world.offered[channel]),
                    static_cast<double>(world.received[channel] - world.disordered), "");
  }
  NoteLatency(figures, world, kStopDown, "one packet in five lost: stop");
  figures.Exactly("  one packet in five lost: commands older than their time-to-live", 0,
                  static_cast<double>(world.late), "");
}

}  // namespace

void Packets(Figures& figures, const Effort& effort) {
  Figures::Section("Packet radios: a message of each channel per 8 to 96 s");
  for (const PacketRadio& radio : PacketRadios()) {
    WithoutLoss(figures, radio, effort);
    WithLoss(figures, radio, effort);
  }
}

}  // namespace priamos::bench
