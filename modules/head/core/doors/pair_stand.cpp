#include "head/core/doors/pair_stand.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "head/core/doors/image_doors.hpp"
#include "head/core/edges/median.hpp"

namespace priamos::head {
namespace {

constexpr double kLowest_m = 0.7, kHighest_m = 1.9, kTried_m = 0.1;  ///< heights that are tried
constexpr double kUsual_m = 1.3;
constexpr double kNearDoor_m = 0.12;   ///< an upright so near to a door's belongs to it
constexpr double kNearFloor_m = 0.25;  ///< its lower end is so near to the floor, before that is known
constexpr double kFootSigma_m = 0.12;  ///< what both cameras see of an upright rarely ends at the floor
constexpr double kPictureRim_px = 8;   ///< what ends here may go on outside of the picture

/// Both views from a floor below the left camera.
struct Standing {
  std::array<CameraModel, 2> cameras;
  std::array<CameraView, 2> views;

  Standing(const std::array<const CameraView*, 2>& own, const CameraStand& stand) {
    for (int c = 0; c < 2; ++c) {
      cameras[c] = OnTheFloor(*own[c]->camera, stand);
      views[c] = SeenFrom(*own[c], cameras[c]);
    }
  }
  Standing(const Standing&) = delete;
  Standing& operator=(const Standing&) = delete;
};

double Total(const std::vector<DetectedDoor>& doors) {
  double sum = 0;
  for (const DetectedDoor& door : doors) sum += door.log_odds;
  return sum;
}

bool EndsInside(const CameraView& view, int line) {
  const double v = std::max(view.lines[line].p.y(), view.lines[line].q.y());
  return v < view.size.height - 1 - kPictureRim_px;
}

bool IsOf(const DetectedDoor& door, const VerticalEdge& edge) {
  for (const double side : {0.5, -0.5}) {
    const Eigen::Vector2d at = door.base_from_door * Eigen::Vector2d(0, side * door.width_m);
    if ((edge.at - at).norm() < kNearDoor_m) return true;
  }
  return false;
}

/// Heights of the lower ends of the doors' uprights above the floor that was assumed [m].
std::vector<double> Feet(const Standing& standing, const std::vector<DetectedDoor>& doors,
                         const DoorDetectionOptions& options) {
  std::vector<double> feet;
  for (const VerticalEdge& edge : MatchVerticals(standing.views[0], standing.views[1], options.stereo)) {
    if (std::abs(edge.z_min_m) > kNearFloor_m || !EndsInside(standing.views[0], edge.left)) continue;
    if (std::any_of(doors.begin(), doors.end(), [&](const DetectedDoor& door) { return IsOf(door, edge); }))
      feet.push_back(edge.z_min_m);
  }
  return feet;
}

/// The height by the doors' feet, or by their lintels.
void Refine(const Standing& standing, const std::vector<DetectedDoor>& doors,
            const DoorDetectionOptions& options, PairStand& found) {
  if (const auto feet = Feet(standing, doors, options); feet.size() > 1) {
    found.source = HeightSource::kFeet;
    found.stand.height_m -= Median(feet);
    found.height_sigma_m = kFootSigma_m;
    return;
  }
  double lift = 0;
  for (const DetectedDoor& door : doors) lift += options.usual_height_m - door.height_m;
  const double n = static_cast<double>(doors.size());
  found.source = HeightSource::kLintels;
  found.stand.height_m += lift / n;
  found.height_sigma_m = options.height_sigma_m / std::sqrt(n);
}

/// All doors of the left image tell the height together, those too far away for stereo, too.
bool UseOneImage(const CameraView& left, PairStand& found) {
  const DoorsInImage alone = DetectDoorsInImage(left, found.stand, TiltAndRollCovariance(found.vertical),
                                                std::nullopt, ImageDoorOptions{});
  if (alone.doors.empty()) return false;
  found.source = HeightSource::kLintels;
  found.stand.height_m = alone.height_m;
  found.height_sigma_m = alone.height_sigma_m;
  return true;
}

}  // namespace

const char* Describe(HeightSource source) {
  switch (source) {
    case HeightSource::kFeet:
      return "feet of doors";
    case HeightSource::kLintels:
      return "the usual height of lintels";
    case HeightSource::kNothing:
      break;
  }
  return "nothing, as no door was seen";
}

PairStand FindPairStand(const CameraView& left, const CameraView& right,
                        const DoorDetectionOptions& options) {
  PairStand found;
  const std::array both{left, right};
  found.vertical = FindVertical(both, {});
  if (found.vertical.verdict != UprightVerdict::kFound) return found;
  const std::array<const CameraView*, 2> own{&left, &right};
  found.stand = StandOf(found.vertical.up, kUsual_m);
  found.height_sigma_m = (kHighest_m - kLowest_m) / 2;
  if (UseOneImage(left, found)) return found;
  double best = 0;
  std::vector<DetectedDoor> doors;
  for (double height = kLowest_m; height < kHighest_m + kTried_m / 2; height += kTried_m) {
    CameraStand stand = found.stand;
    stand.height_m = height;
    const Standing standing(own, stand);
    auto seen = DetectDoors(standing.views[0], standing.views[1], options);
    if (const double total = Total(seen); total > best) {
      best = total;
      doors = std::move(seen);
      found.source = HeightSource::kLintels;
      found.stand.height_m = height;
    }
  }
  if (!doors.empty()) Refine(Standing(own, found.stand), doors, options, found);
  return found;
}

}  // namespace priamos::head
