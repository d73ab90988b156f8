#include "bus/radio/shared_budget.hpp"

#include <fmt/format.h>

#include <optional>

#include "bus/radio/budget_analysis.hpp"

namespace priamos::bus::radio {
namespace {

/// How often each end looks.
constexpr Duration kTick{1'000};

}  // namespace

SharedChannel SharedChannelOf(const ChannelTable& table, const LinkOptions& options) {
  const DirectionAnalysis up(table, options, Direction::kUp);
  return {.turnaround = options.half_duplex.turnaround,
          .latency = options.line_delay / 2,
          .grace = options.grace,
          .answer = up.LongestFrameTime()};
}

PollBounds PollBoundsOf(const ChannelTable& table, const LinkOptions& options) {
  const DirectionAnalysis down(table, options, Direction::kDown);
  return ComputePollBounds(
      SharedChannelOf(table, options),
      {.poll = down.LongestFrameTime(), .urgent = FromSeconds(down.UrgentFrameSeconds())}, options.robots,
      kTick);
}

std::vector<std::string> SharedProblems(const ChannelTable& table, const LinkOptions& options) {
  std::vector<std::string> problems;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    const std::size_t least = DirectionAnalysis(table, options, direction).SmallestBundleBytes();
    if (least <= options.max_bundle_bytes) continue;
    problems.push_back(fmt::format(
        "{}: radio link {}: expected a max_bundle_bytes of at least {} with several robots, in which "
        "each message has room beside acknowledgements, got {}: raise it, or shorten the "
        "longest message",
        options.place.Of("max_bundle_bytes"), NameOf(direction), least, options.max_bundle_bytes));
  }
  return problems;
}

std::string FormatPollBounds(const PollBounds& bounds, int robots) {
  const auto seconds = [](const std::optional<Duration>& d) {
    return d ? fmt::format("{:.3f} s", Seconds(*d)) : std::string("no bound");
  };
  return fmt::format(
      "{} robots on one channel: each is polled at least every {:.3f} s, one that is driven every {:.3f} s; "
      "beside emergency stops to all, {} and {}\n"
      "an emergency stop takes at most {:.3f} s to one robot, {:.3f} s to all\n",
      robots, Seconds(bounds.cycle), Seconds(bounds.asked), seconds(bounds.busy_cycle),
      seconds(bounds.busy_asked), Seconds(bounds.urgent_one), Seconds(bounds.urgent_all));
}

}  // namespace priamos::bus::radio
