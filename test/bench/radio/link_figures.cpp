// Efficiency, bit errors, loss, overload, blackouts.
#include "figures.hpp"
#include "test/bus/radio/measurement/blackout_measurement.hpp"
#include "test/bus/radio/measurement/first_pose_measurement.hpp"
#include "test/bus/radio/measurement/goodput_measurement.hpp"
#include "test/bus/radio/measurement/overload_measurement.hpp"

namespace priamos::bench {

using namespace bus::radio;

namespace {

void Errors(Figures& figures, const Effort& effort) {
  Figures::Section("Bit errors: goodput of events, share of that without errors");
  const double seconds = effort.long_run ? 1200 : 300;
  const double clean = EventGoodput(0, 1, seconds).bytes_per_s;
  figures.Note("without errors", clean, "byte/s");
  for (const auto& [rate, asked] : {std::pair{1e-5, 95.0}, {1e-4, 80.0}, {1e-3, 25.0}}) {
    const Goodput goodput = EventGoodput(rate, 2, seconds);
    figures.AtLeast(fmt::format("bit error rate {:g}", rate), asked, 100 * goodput.bytes_per_s / clean, "%");
    figures.Exactly("  all once and in order", 1, goodput.once_in_order ? 1 : 0, "");
  }
}

void Events(Figures& figures, const Effort& effort) {
  const int runs = effort.long_run ? 500 : 100;
  Figures::Section("Events at 30 % frame loss, both ends restarted now and then");
  int good = 0;
  for (int seed = 1; seed <= runs; ++seed)
    good += EventsArriveOnceInOrder(static_cast<std::uint64_t>(seed), 60, 0.3, 0.1) ? 1 : 0;
  figures.Exactly("runs of 120 events in which all came once and in order", runs, good, "runs");
}

void Load(Figures& figures, const Effort& effort) {
  Figures::Section("Three times the line offered");
  Overload worst;
  worst.offered_share = 100;
  const int runs = effort.long_run ? 20 : 5;
  for (int seed = 1; seed <= runs; ++seed) {
    const Overload one = MeasureOverload(static_cast<std::uint64_t>(seed), 300);
    worst.offered_share = std::min(worst.offered_share, one.offered_share);
    worst.worst_bound_used = std::max(worst.worst_bound_used, one.worst_bound_used);
    worst.lowest_floor = std::min(worst.lowest_floor, one.lowest_floor);
    worst.worst_queue_age = std::max(worst.worst_queue_age, one.worst_queue_age);
    worst.timed += one.timed;
  }
  figures.AtLeast("offered", 3, worst.offered_share, "times the line, each way");
  figures.Note("commands and events timed", static_cast<double>(worst.timed), "");
  figures.AtMost("largest latency of one of them over its computed bound", 1, worst.worst_bound_used, "");
  figures.AtLeast("lowest rate of a state channel over its rate_hz", 0.97, worst.lowest_floor, "");
  figures.AtMost("oldest message in a queue over its time-to-live", 1, worst.worst_queue_age, "");
}

void Dark(Figures& figures, const Effort& effort) {
  Figures::Section("Blackouts of 1 to 30 s, the link up 15 % of the time in windows of 1 s");
  const Blackouts result = MeasureBlackouts(1, effort.long_run ? 20000 : 5000);
  figures.Note("returns", result.returns, "");
  figures.AtMost("slowest fresh state (made after the return)", 0.3, result.slowest_fresh_s, "s");
  figures.AtMost("oldest command delivered (time-to-live 0.25 s)", 0.25, result.oldest_command_s, "s");
  figures.Note("commands delivered", result.commands, "");
  figures.Exactly("events all delivered, once and in order", 1, result.events_once_in_order ? 1 : 0, "");
}

void FirstPose(Figures& figures, const Effort& effort) {
  Figures::Section(
      "The shipped link, every channel at its rate: from the end of a blackout of 0.05 to 8 s to a pose of "
      "after it");
  const std::size_t returns = effort.long_run ? 10000 : 2500;
  const auto note = [&](const char* cut, bool up, bool down) {
    const FirstPoses poses = FirstPoseRun(1, up, down, 1).Run(returns);
    figures.AtLeast(fmt::format("{}: within 0.3 s", cut), 99, 100 * poses.ShareWithin(0.3), "%");
    figures.Note("  slowest", poses.worst_s(), "s");
  };
  note("both directions cut", true, true);
  note("up cut", true, false);
  note("down cut", false, true);
}

}  // namespace

void SimulatedLink(Figures& figures, const Effort& effort) {
  Figures::Section("Saturated, no errors");
  const Saturation saturation = Saturate(300);
  figures.Note("line used", 100 * saturation.line_used, "%");
  figures.AtLeast("bundle bytes of the bytes on the line", 93, 100 * saturation.bundle_share, "%");
  figures.AtLeast("bytes of messages, of events of 10 bytes each", 75, 100 * GoodputShare(10, 300), "%");
  figures.AtLeast("bytes of messages, of events of 26 bytes each", 85, 100 * GoodputShare(26, 300), "%");
  Errors(figures, effort);
  Events(figures, effort);
  Load(figures, effort);
  Dark(figures, effort);
  FirstPose(figures, effort);
}

}  // namespace priamos::bench
