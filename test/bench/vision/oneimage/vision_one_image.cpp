#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "head/core/doors/pair_stand.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/bench/vision/oneimage/held_truth.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr int kHeldLooks = 6;  ///< per corridor
constexpr double kPlaced_m = 0.03;

double QuantileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double Share(double part, double of) {
  return 100 * part / std::max(1.0, of);
}

/// Doors that were found, and errors of those to be found.
struct DoorTally {
  int asked = 0, found = 0, reported = 0, wrong = 0;
  std::vector<double> yaw_deg, shape, range, middle_m;
  std::vector<double> yaw_sigmas, shape_sigmas, range_sigmas;

  /// Counts what was reported, and what was not found; the true doors in the order of `reported`.
  template <typename Door>
  std::vector<const TrueDoor*> Add(const CorridorLook& look, const HeldTruth& truth,
                                   const std::vector<Door>& doors) {
    std::vector<const TrueDoor*> right;
    std::set<const TrueDoor*> known;
    for (const Door& door : doors) {
      const TrueDoor* match = truth.Match(door);
      const bool is_right = match && known.insert(match).second;
      right.push_back(is_right ? match : nullptr);
      ++reported;
      wrong += !is_right;
    }
    for (const TrueDoor& door : look.doors) {
      asked += door.is_to_be_found;
      found += door.is_to_be_found && known.contains(&door);
    }
    return right;
  }
};

void AddErrors(const HeldTruth& truth, const TrueDoor& door, const head::ImageDoor& told, DoorTally& tally) {
  const Pose2 place = truth.PlaceOf(door);
  const double yaw = std::abs(WrapAngle(told.base_from_door.yaw - place.yaw)),
               width = (door.left - door.right).norm(), range = place.translation().norm();
  const double shape =
      std::min(std::abs(told.shape - width / door.height_m),
               std::abs(told.shape - (width + 2 * door.frame_m) / (door.height_m + door.frame_m)));
  tally.yaw_deg.push_back(Degrees(yaw));
  tally.shape.push_back(100 * shape / (width / door.height_m));
  tally.range.push_back(100 * std::abs(told.range_m - range) / range);
  tally.yaw_sigmas.push_back(yaw / told.yaw_sigma_rad);
  tally.shape_sigmas.push_back(shape / told.shape_sigma);
  tally.range_sigmas.push_back(std::abs(told.range_m - range) / told.range_sigma_m);
}

struct StandTally {
  int looks = 0, refused = 0;
  std::vector<double> tilt_deg, roll_deg, sigmas, height_m;

  void Add(const head::VerticalDirection& vertical, const head::CameraStand& truth) {
    ++looks;
    refused += vertical.verdict != head::UprightVerdict::kFound;
    if (vertical.verdict != head::UprightVerdict::kFound) return;
    const head::CameraStand told = head::StandOf(vertical.up, 0);
    const Eigen::Vector2d off(told.tilt_rad - truth.tilt_rad, told.roll_rad - truth.roll_rad);
    tilt_deg.push_back(Degrees(std::abs(off.x())));
    roll_deg.push_back(Degrees(std::abs(off.y())));
    const Eigen::Matrix2d covariance = head::TiltAndRollCovariance(vertical);
    sigmas.push_back(std::abs(off.x()) / std::sqrt(covariance(0, 0)));
  }
};

/// Everything that is asked about the looks.
struct HeldCount {
  StandTally image, pair;
  DoorTally alone, with_height, estimated, told;
  double seconds = 0, most_s = 0, pair_s = 0;
};

void LookAlone(const CorridorLook& look, const HeldTruth& truth, const head::EdgeImage& edges, bool verbose,
               HeldCount& count) {
  const head::CameraModel own = InFrameOf(look.calibrated[0], look.calibrated[0]);
  const double start = CpuSeconds();
  const head::CameraView view = head::MakeView(own, edges);
  const auto vertical = head::FindVertical(std::span(&view, 1), {});
  const bool is_known = vertical.verdict == head::UprightVerdict::kFound;
  const head::CameraStand stand = head::StandOf(vertical.up, 0);
  const auto detect = [&](std::optional<double> height_m) {
    return is_known
               ? head::DetectDoorsInImage(view, stand, head::TiltAndRollCovariance(vertical), height_m, {})
               : head::DoorsInImage{};
  };
  const head::DoorsInImage found = detect(std::nullopt);
  const double seconds = CpuSeconds() - start;
  count.seconds += seconds;
  count.most_s = std::max(count.most_s, seconds);
  count.image.Add(vertical, truth.stand());
  const auto right = count.alone.Add(look, truth, found.doors);
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (verbose && !right[i])
      fmt::print("  look {}: false at {:.0f} {:.0f}, log odds {:.1f}\n", count.image.looks,
                 found.doors[i].corners[0].x(), found.doors[i].corners[0].y(), found.doors[i].log_odds);
    if (right[i] && right[i]->is_to_be_found) AddErrors(truth, *right[i], found.doors[i], count.alone);
  }
  if (!found.doors.empty()) count.image.height_m.push_back(std::abs(found.height_m - truth.stand().height_m));
  count.with_height.Add(look, truth, detect(truth.stand().height_m).doors);
}

/// Doors of a pair with a stand.
void LookWith(const head::CameraStand& stand, const CorridorLook& look, const HeldTruth& truth,
              const std::array<head::CameraView, 2>& own, DoorTally& tally) {
  const std::array cameras{head::OnTheFloor(*own[0].camera, stand), head::OnTheFloor(*own[1].camera, stand)};
  const auto doors =
      head::DetectDoors(head::SeenFrom(own[0], cameras[0]), head::SeenFrom(own[1], cameras[1]), {});
  const auto right = tally.Add(look, truth, doors);
  for (std::size_t i = 0; i < right.size(); ++i)
    if (right[i] && right[i]->is_to_be_found)
      tally.middle_m.push_back(
          (truth.PlaceOf(*right[i]).translation() - doors[i].base_from_door.translation()).norm());
}

void LookAsPair(const CorridorLook& look, const HeldTruth& truth, const std::array<head::EdgeImage, 2>& edges,
                HeldCount& count) {
  const std::array cameras{InFrameOf(look.calibrated[0], look.calibrated[0]),
                           InFrameOf(look.calibrated[0], look.calibrated[1])};
  const std::array own{head::MakeView(cameras[0], edges[0]), head::MakeView(cameras[1], edges[1])};
  const double start = CpuSeconds();
  const head::PairStand found = head::FindPairStand(own[0], own[1], {});
  count.pair_s += CpuSeconds() - start;
  count.pair.Add(found.vertical, truth.stand());
  if (found.source != head::HeightSource::kNothing)
    count.pair.height_m.push_back(std::abs(found.stand.height_m - truth.stand().height_m));
  if (found.vertical.verdict == head::UprightVerdict::kFound)
    LookWith(found.stand, look, truth, own, count.estimated);
  else
    count.estimated.Add(look, truth, std::vector<head::DetectedDoor>());
  LookWith(truth.stand(), look, truth, own, count.told);
}

void PrintStand(const char* of, const StandTally& tally, Figures& figures) {
  figures.Note(fmt::format("  {}: stand refused", of), Share(tally.refused, tally.looks), "%");
  figures.Note("    error of tilt, median", QuantileOf(tally.tilt_deg, 0.5), "deg");
  figures.AtMost("    error of tilt, 95 %", QuantileOf(tally.tilt_deg, 0.95), 0.3, "deg");
  figures.AtMost("    error of roll, 95 %", QuantileOf(tally.roll_deg, 0.95), 0.15, "deg");
  figures.Note("    error of tilt over its sigma, 95 %", QuantileOf(tally.sigmas, 0.95), "");
  figures.Note("    error of the height, median", QuantileOf(tally.height_m, 0.5), "m");
  figures.Note("    error of the height, 90 %", QuantileOf(tally.height_m, 0.9), "m");
}

void PrintFound(const char* of, const DoorTally& tally, double found, double wrong, Figures& figures) {
  figures.AtLeast(fmt::format("  {}: found, of {} to be found", of, tally.asked),
                  Share(tally.found, tally.asked), found, "%");
  figures.AtMost(fmt::format("    false ones, of {} that were reported", tally.reported),
                 Share(tally.wrong, tally.reported), wrong, "%");
}

void PrintErrors(const DoorTally& tally, Figures& figures) {
  const auto print = [&](const char* what, const std::vector<double>& errors,
                         const std::vector<double>& sigmas, const char* unit) {
    figures.Note(fmt::format("    {}, median", what), QuantileOf(errors, 0.5), unit);
    figures.Note(fmt::format("    {}, 90 %", what), QuantileOf(errors, 0.9), unit);
    figures.Note(fmt::format("    {} over its sigma, 90 %", what), QuantileOf(sigmas, 0.9), "");
  };
  print("error of the direction", tally.yaw_deg, tally.yaw_sigmas, "deg");
  print("error of width over height", tally.shape, tally.shape_sigmas, "%");
  print("error of the distance", tally.range, tally.range_sigmas, "%");
}

void PrintPair(const char* of, const DoorTally& tally, Figures& figures) {
  PrintFound(of, tally, 98.5, 0.5, figures);
  const auto off = std::count_if(tally.middle_m.begin(), tally.middle_m.end(),
                                 [](double error) { return error > kPlaced_m; });
  figures.AtMost("    middle more than 3 cm beside the truth",
                 Share(static_cast<double>(off), static_cast<double>(tally.middle_m.size())), 2, "%");
}

void PrintHeld(const HeldCount& count, Figures& figures) {
  PrintStand("one image", count.image, figures);
  PrintFound("one image", count.alone, 90, 3, figures);
  PrintErrors(count.alone, figures);
  PrintFound("one image, its height told", count.with_height, 90, 3, figures);
  figures.Note("  time per image beside the edges", 1000 * count.seconds / count.image.looks, "ms");
  figures.AtMost("  the longest", 1000 * count.most_s, 20, "ms");
  PrintStand("pair", count.pair, figures);
  PrintPair("pair, stand found", count.estimated, figures);
  PrintPair("pair, stand told", count.told, figures);
  figures.Note("  time for the stand of a pair", 1000 * count.pair_s / count.image.looks, "ms");
}

}  // namespace

void BenchOneImage(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 10 : 50;
  fmt::print(
      "doors in {} corridors, {} looks each, by cameras that are held 1 to 1.5 m high, tilted by up to 8 and "
      "rolled by up to 2 degrees, which nobody tells\n",
      n, kHeldLooks);
  CorridorPhotographer photographer;
  head::EdgeOperator edge_operator(head::DoorEdges());
  HeldCount count;
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    for (const CorridorLook& look :
         photographer.Take(seed, kHeldLooks, CalibrateSpecimen(seed % 7 + 1), {}, Hold::kInAHand)) {
      std::array<head::EdgeImage, 2> edges;
      for (int c = 0; c < 2; ++c) edge_operator.Extract(look.images[c], edges[c]);
      const HeldTruth truth(look);
      LookAlone(look, truth, edges[0], options.verbose, count);
      LookAsPair(look, truth, edges, count);
    }
  }
  PrintHeld(count, figures);
}

}  // namespace priamos::bench
