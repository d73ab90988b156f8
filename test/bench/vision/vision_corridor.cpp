#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "head/core/doors/door_detection.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/bench/vision/corridor_looks.hpp"
#include "test/bench/vision/corridor_states.hpp"
#include "test/bench/vision/timed_doors.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr double kSameDoor_m = 0.25, kWellPlaced_m = 0.03;
constexpr double kSure_m = 0.02;  ///< a detection that claims less is told apart
constexpr int kLooksPerCorridor = 6;

struct Tally {
  int asked = 0, found = 0;
};

struct Count {
  int looks = 0, reported = 0, false_ones = 0, off = 0, jamb_off = 0, sure = 0, sure_but_off = 0;
  Tally asked, others;  ///< doors to be found; doors in both pictures that are too far, too slanted or hidden
  std::map<std::string, Tally> by_kind;
  std::vector<double> middle_m, jamb_m;  ///< errors of those to be found
  StateTally states;
};

/// Error of both jambs, the worse one. What is reported may be the frame's outer or its inner edges.
double JambError(const TrueDoor& door, const head::DetectedDoor& detected) {
  const Eigen::Vector2d left = detected.base_from_door * Eigen::Vector2d(0, detected.width_m / 2),
                        right = detected.base_from_door * Eigen::Vector2d(0, -detected.width_m / 2);
  const Eigen::Vector2d frame = door.frame_m * (door.left - door.right).normalized();
  const auto error = [&](const Eigen::Vector2d& wider) {
    return std::max((left - door.left - wider).norm(), (right - door.right + wider).norm());
  };
  return std::min(error(Eigen::Vector2d::Zero()), error(frame));
}

/// Standard deviation that a detection claims for its middle [m].
double Sigma(const head::DetectedDoor& detected) {
  return std::sqrt(detected.covariance.trace());
}

void PrintMisplaced(int look, const TrueDoor& door, const head::DetectedDoor& detected, double middle_m,
                    double jamb_m) {
  fmt::print(
      "  look {}: middle {:.0f} mm beside the truth (sigma {:.0f}), worse jamb {:.0f} mm, at {:.1f} m, slant "
      "{:.0f}, "
      "open {:.0f}, width {:.3f} instead of {:.3f} m, log odds {:.1f}\n",
      look, 1000 * middle_m, 1000 * Sigma(detected), 1000 * jamb_m, door.range_m, door.slant_deg,
      door.open_deg, detected.width_m, (door.left - door.right).norm(), detected.log_odds);
}

const TrueDoor* Nearest(const CorridorLook& look, const head::DetectedDoor& detected) {
  const auto distance = [&](const TrueDoor& door) {
    return (door.middle() - detected.base_from_door.translation()).norm();
  };
  const auto nearest =
      std::min_element(look.doors.begin(), look.doors.end(),
                       [&](const TrueDoor& a, const TrueDoor& b) { return distance(a) < distance(b); });
  return nearest != look.doors.end() && distance(*nearest) < kSameDoor_m ? &*nearest : nullptr;
}

std::vector<std::string> KindsOf(const TrueDoor& door) {
  return {door.open_deg == 0   ? "closed"
          : door.open_deg < 30 ? "ajar"
                               : "open",
          door.opens_to_us ? "opens into the corridor" : "opens into the room",
          door.slant_deg < 30 ? "slant below 30 degrees"
                              : (door.slant_deg < 60 ? "slant 30 to 60 degrees" : "slant above 60 degrees"),
          door.range_m < 3.5 ? "nearer than 3.5 m" : "farther than 3.5 m"};
}

void Add(const CorridorLook& look, const std::vector<head::DetectedDoor>& detected, bool verbose,
         Count& count) {
  std::vector<const TrueDoor*> found;
  ++count.looks;
  count.reported += static_cast<int>(detected.size());
  for (const head::DetectedDoor& d : detected) {
    const TrueDoor* door = Nearest(look, d);
    if (!door) {
      ++count.false_ones;
      if (verbose)
        fmt::print("  look {}: false at {:.2f} {:.2f}, log odds {:.1f}\n", count.looks, d.base_from_door.x,
                   d.base_from_door.y, d.log_odds);
      continue;
    }
    found.push_back(door);
    if (!door->is_to_be_found) continue;
    count.states.Add(look, *door, d, verbose);
    const double middle = (door->middle() - d.base_from_door.translation()).norm(),
                 jamb = JambError(*door, d);
    count.middle_m.push_back(middle);
    count.jamb_m.push_back(jamb);
    const bool is_sure = Sigma(d) < kSure_m;
    count.sure += is_sure;
    count.sure_but_off += is_sure && middle > kWellPlaced_m;
    count.off += middle > kWellPlaced_m;
    count.jamb_off += jamb > kWellPlaced_m;
    if (verbose && jamb > kWellPlaced_m) PrintMisplaced(count.looks, *door, d, middle, jamb);
  }
  for (const TrueDoor& door : look.doors) {
    const bool is_found = std::find(found.begin(), found.end(), &door) != found.end();
    const auto add = [&](Tally& tally) { ++tally.asked, tally.found += is_found; };
    if (door.is_to_be_found) {
      add(count.asked);
      for (const std::string& kind : KindsOf(door)) add(count.by_kind[kind]);
      if (verbose && !is_found)
        fmt::print("  look {}: missed at {:.1f} m, slant {:.0f}, open {:.0f}\n", count.looks, door.range_m,
                   door.slant_deg, door.open_deg);
    } else if (door.why_not != kOutOfThePicture) {
      add(count.others);
    }
  }
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double Percent(double part, double of) {
  return 100 * part / std::max(1.0, of);
}

void Print(const Count& count, double seconds, Figures& figures) {
  figures.AtLeast("  found, of those to be found", Percent(count.asked.found, count.asked.asked), 98, "%");
  for (const auto& [kind, tally] : count.by_kind)
    figures.Note(fmt::format("    {} ({})", kind, tally.asked), Percent(tally.found, tally.asked), "%");
  figures.Note(fmt::format("  farther, more slanted or partly hidden ones ({})", count.others.asked),
               Percent(count.others.found, count.others.asked), "%");
  figures.AtMost("  false ones, of all that were reported", Percent(count.false_ones, count.reported), 1,
                 "%");
  figures.Note("  false ones, of all looks", Percent(count.false_ones, count.looks), "%");
  const double n = static_cast<double>(count.middle_m.size());
  figures.AtMost("  middle more than 3 cm beside the truth", Percent(count.off, n), 2, "%");
  figures.AtMost(
      fmt::format("    of those that claim a sigma below {:.0f} cm ({})", 100 * kSure_m, count.sure),
      Percent(count.sure_but_off, count.sure), 1, "%");
  figures.AtMost("  middle, 95 % of them nearer than", 1000 * Quantile(count.middle_m, 0.95), 30, "mm");
  figures.Note("  middle, median", 1000 * Quantile(count.middle_m, 0.5), "mm");
  figures.Note("  a jamb more than 3 cm beside the truth", Percent(count.jamb_off, n), "%");
  figures.Note("  worse jamb, median", 1000 * Quantile(count.jamb_m, 0.5), "mm");
  count.states.Print(figures);
  figures.Note("  time per stereo pair, edges included", 1000 * seconds / count.looks, "ms");
}

}  // namespace

void BenchCorridor(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 10 : 100;
  const ToBeFound rule;
  fmt::print(
      "doors in {} corridors, {} looks each; to be found: whole lintel in both pictures, {} to {} m away, "
      "slant up to {} degrees, {} m and {:.0f} % of each jamb and {:.0f} % of the lintel not hidden\n",
      n, kLooksPerCorridor, rule.min_range_m, rule.max_range_m, rule.max_slant_deg, rule.jamb_m,
      100 * rule.jamb_share, 100 * rule.lintel_share);
  CorridorPhotographer photographer;
  head::EdgeOperator edge_operator(head::DoorEdges());
  Count count;
  double seconds = 0;
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    for (const CorridorLook& look :
         photographer.Take(seed, kLooksPerCorridor, CalibrateSpecimen(seed % 7 + 1), rule)) {
      const auto doors = DetectTimed(look.images, look.calibrated, edge_operator, seconds);
      Add(look, doors, options.verbose, count);
    }
  }
  Print(count, seconds, figures);
}

}  // namespace priamos::bench
