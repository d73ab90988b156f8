#include "head/see/find_doors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "head/core/doors/pair_stand.hpp"
#include "head/core/edges/equal_contrast.hpp"
#include "head/see/see_doors.hpp"

namespace priamos::head {
namespace {

constexpr double kFarthestDoor_m = 12;       // nobody drives by these: far ones may be uncertain
constexpr double kWidthOfOneImage_m = 0.05;  // so much less exactly one image alone tells a door's width

DoorDetectionOptions PairOptions(double max_width_m) {
  DoorDetectionOptions options;
  options.stereo.max_range_m = kFarthestDoor_m;
  if (const double wider_m = max_width_m - options.max_width_m; wider_m > 0) {  // one leaf or two
    options.width_sigma_m += wider_m / 2;
    options.usual_width_m += wider_m / 2;
  }
  options.max_width_m = max_width_m;
  return options;
}

void SetAttitude(const VerticalDirection& vertical, SeenStand& seen) {
  const CameraStand stand = StandOf(vertical.up, seen.stand.height_m);
  seen.stand = stand;
  seen.covariance = TiltAndRollCovariance(vertical);
  seen.is_estimated = true;
}

/// What was told of the stand; a height alone leaves the rest to the images if these are asked.
SeenStand Told(const SeeOptions& options) {
  SeenStand seen;
  if (!options.stand.empty()) seen.stand = StandFrom(options.stand);
  return seen;
}

bool LeavesAttitude(const SeeOptions& options) {
  return options.doors && options.stand.size() < 2;
}

void FindInImage(const SeeOptions& options, const std::vector<CameraView>& own, SeenDoors& seen) {
  if (LeavesAttitude(options)) {
    const VerticalDirection vertical = FindVertical(own, {});
    seen.why_not = vertical.verdict == UprightVerdict::kFound ? "" : Describe(vertical.verdict);
    if (!seen.why_not.empty()) return;
    SetAttitude(vertical, seen.stand);
  }
  std::optional<double> height;
  if (!options.stand.empty()) height = seen.stand.stand.height_m;
  ImageDoorOptions wanted;
  wanted.max_width_m = options.max_door_width_m + kWidthOfOneImage_m;
  DoorsInImage found = DetectDoorsInImage(own[0], seen.stand.stand, seen.stand.covariance, height, wanted);
  seen.in_image = std::move(found.doors);
  if (height) return;
  if (seen.in_image.empty()) {
    seen.stand.height_from = Describe(HeightSource::kNothing);
    return;
  }
  seen.stand.stand.height_m = found.height_m;
  seen.stand.height_sigma_m = found.height_sigma_m;
  seen.stand.height_from = Describe(HeightSource::kLintels);
}

/// The stand of a pair, as far as it was not told.
void FindStand(const SeeOptions& options, const std::vector<CameraView>& own, SeenDoors& seen) {
  VerticalDirection vertical;
  if (options.stand.empty()) {
    const PairStand found = FindPairStand(own[0], own[1], PairOptions(options.max_door_width_m));
    vertical = found.vertical;
    seen.stand.stand.height_m = found.stand.height_m;
    seen.stand.height_sigma_m = found.height_sigma_m;
    seen.stand.height_from = Describe(found.source);
  } else {
    vertical = FindVertical(own, {});
  }
  if (vertical.verdict != UprightVerdict::kFound)
    seen.why_not = Describe(vertical.verdict);
  else
    SetAttitude(vertical, seen.stand);
}

}  // namespace

bool WantsDoors(const SeeOptions& options) {
  return options.doors || !options.stand.empty();
}

SeenDoors FindDoors(const SeeOptions& options, std::span<const cv::Mat> greys,
                    const std::vector<CameraModel>& cameras) {
  const std::size_t n = cameras.size();
  if (n != 1 && n != 2)
    throw std::runtime_error(
        fmt::format("expected one or two images and their cameras to look for doors, got {} cameras", n));
  SeenDoors seen{cameras, std::vector<EdgeImage>(n), {}, {}, {}, Told(options), ""};
  if (n == 1) seen.cameras[0].image_from_base.col(3).setZero();  // one camera is the origin
  const auto edge_options = ForOneScene(std::vector<cv::Mat>(greys.begin(), greys.end()), DoorEdges());
  std::vector<CameraView> own;
  for (std::size_t c = 0; c < n; ++c) {
    EdgeOperator(edge_options[c]).Extract(greys[c], seen.edges[c]);
    own.push_back(MakeView(seen.cameras[c], seen.edges[c]));
  }
  if (n == 1)
    FindInImage(options, own, seen);
  else if (LeavesAttitude(options))
    FindStand(options, own, seen);
  for (CameraModel& camera : seen.cameras) camera = OnTheFloor(camera, seen.stand.stand);
  for (std::size_t c = 0; c < n; ++c) seen.views.push_back(SeenFrom(own[c], seen.cameras[c]));
  if (n == 2 && seen.why_not.empty())
    seen.doors = DetectDoors(seen.views[0], seen.views[1], PairOptions(options.max_door_width_m));
  return seen;
}

}  // namespace priamos::head
