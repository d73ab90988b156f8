#include "bus/radio/budget.hpp"
#include "figures.hpp"
#include "test/bus/radio/shared/shared_traffic.hpp"

// Four robots on one channel of 9600 baud, 20 ms turnaround: every message timed beside its bound.

namespace priamos::bench {
namespace {

using namespace bus::radio;

constexpr std::uint8_t kRobots = 4;

std::vector<double> InSeconds(const std::vector<Duration>& latencies) {
  std::vector<double> seconds;
  for (const Duration d : latencies) seconds.push_back(Seconds(d));
  return seconds;
}

/// Messages that took longer than the budget says, by which the line's own 1 ms does not count.
std::size_t BeyondBound(SharedTraffic& traffic, const Budget& budget) {
  std::size_t beyond = 0;
  const auto count = [&](std::size_t kind, Duration bound) {
    for (const Duration took : traffic.of(kind).latencies) beyond += took > bound + Duration(1'000) ? 1 : 0;
  };
  for (const DirectionBudget* d : {&budget.up, &budget.down})
    for (const ChannelBudget& row : d->channels)
      if (row.channel != kSharedStop) count(row.channel, row.worst_latency.value());
  count(kSharedStop, budget.polls.urgent_one);
  count(SharedTraffic::kStopToAll, budget.polls.urgent_all);
  return beyond;
}

void NoteLatencies(Figures& figures, SharedTraffic& traffic, std::size_t kind, const std::string& what) {
  const auto s = InSeconds(traffic.of(kind).latencies);
  figures.Note(what + ", median", Quantile(s, 0.5), "s");
  figures.Note(what + ", p99.9", Quantile(s, 0.999), "s");
  figures.Note(what + ", longest", Quantile(s, 1), "s");
}

}  // namespace

void SharedChannel(Figures& figures, const Effort& effort) {
  Figures::Section("four robots on one channel, no bit errors");
  SharedWorld world(kRobots, effort.seed);
  const Budget budget = ComputeBudget(ChannelTable(SharedTestChannels(), false), world.options);
  figures.AtMost("bound of an emergency stop to one", 0.150, Seconds(budget.polls.urgent_one), "s");
  figures.AtMost("bound of one to all four", 0.200, Seconds(budget.polls.urgent_all), "s");
  world.Run(5);
  SharedTraffic traffic(world, kRobots, effort.seed);
  const double seconds = effort.long_run ? 10'700 : 1'000;
  traffic.Run(seconds);
  figures.Note("messages timed", static_cast<double>(traffic.timed()), "");
  figures.Exactly("messages beyond their bound", 0, static_cast<double>(BeyondBound(traffic, budget)), "");
  figures.AtLeast("of the poses that were offered, came", 99,
                  100 * static_cast<double>(traffic.of(kSharedPose).latencies.size()) /
                      static_cast<double>(traffic.of(kSharedPose).offered),
                  "%");
  NoteLatencies(figures, traffic, kSharedStop, "emergency stop to one");
  NoteLatencies(figures, traffic, SharedTraffic::kStopToAll, "emergency stop to all four");
  NoteLatencies(figures, traffic, kSharedPose, "pose");
  NoteLatencies(figures, traffic, kSharedDrive, "drive command to the one that is driven");
  SharedWorld steady(kRobots, effort.seed + 1);
  steady.Run(5);
  SharedTraffic poses(steady, kRobots, effort.seed + 1);
  poses.KeepPosesComing();
  poses.Run(600, 0);
  figures.AtLeast("poses per second of each robot that always has one", 0.99,
                  static_cast<double>(poses.of(kSharedPose).latencies.size()) / 600 / kRobots, "1/s");
}

}  // namespace priamos::bench
