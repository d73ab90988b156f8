#include "cli/report/report_found_objects.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "cli/report/report_timeline.hpp"
#include "common/learned/object_book.hpp"
#include "planner/map_keeper.hpp"

namespace priamos::cli {
namespace {

using Eigen::Vector2d;

/// Fronts are looked at in such steps.
constexpr double kFrontStep_m = 0.05;
/// A true surface that is so near is what was seen.
constexpr double kOnSurface_m = 0.1;
/// What begins so far above a thing, or ends so far below it, is another one.
constexpr double kBeyondHeight_m = 0.1;

/// The things at the end of the run.
LearnedWalls ObjectsOf(const RunRecord& record) {
  LearnedWalls map;
  for (const scene_object_t& message : record.objects)
    if (const auto told = planner::FromMessage(message)) EnterObject(*told, map);
  return map;
}

/// To the nearest face of a solid; inside as well.
double ToSurface(const world::Solid& solid, const Vector2d& at) {
  const auto corners = Rectangle{solid.map_from_solid, solid.size_m / 2}.Corners();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i)
    nearest_m = std::min(nearest_m, DistanceToSegment(corners[i], corners[(i + 1) % corners.size()], at));
  return nearest_m;
}

/// How far places along its front are from the nearest true surface at its height.
std::vector<double> FrontDistances(const LearnedObject& object, const Pose2& truth_from_belief,
                                   const TrueWorld& world) {
  const Pose2 front = truth_from_belief * object.map_from_front();
  const int steps = static_cast<int>(std::ceil(object.width_m / kFrontStep_m));
  std::vector<double> distances;
  for (int i = 0; i <= steps; ++i) {
    const double along_m = steps == 0 ? 0 : object.width_m * (double(i) / steps - 0.5);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const world::Solid& solid : world.solids) {
      const bool at_height = solid.z_min_m <= object.top_m + kBeyondHeight_m &&
                             solid.z_max_m >= object.bottom_m - kBeyondHeight_m;
      if (at_height) nearest_m = std::min(nearest_m, ToSurface(solid, front * Vector2d(0, along_m)));
    }
    distances.push_back(nearest_m);
  }
  return distances;
}

void Count(const LearnedObject& object, const std::vector<double>& front_m, FoundObjects& found) {
  ++(object.kind == "edge" ? found.edges : object.kind == "face" ? found.faces : found.boxes);
  const auto near = std::count_if(front_m.begin(), front_m.end(), [](double m) { return m <= kOnSurface_m; });
  if (near == 0) ++found.phantoms;
  if (near > 0 && 2 * near >= std::ptrdiff_t(front_m.size())) ++found.standing;
}

}  // namespace

std::optional<FoundObjects> FoundObjectsOf(const RunRecord& record, const RunInfo& info) {
  FoundObjects found;
  std::vector<double> all_m;
  for (const LearnedObject& object : ObjectsOf(record).objects) {
    const auto belief_from_truth =
        BeliefFromTruth(record, static_cast<std::int64_t>(std::llround(object.seen_s * 1e6)));
    if (!belief_from_truth) continue;
    const auto front_m = FrontDistances(object, belief_from_truth->Inverse(), info.world);
    Count(object, front_m, found);
    all_m.insert(all_m.end(), front_m.begin(), front_m.end());
  }
  if (all_m.empty()) return std::nullopt;
  const auto p95 = all_m.begin() + std::ptrdiff_t(0.95 * double(all_m.size() - 1));
  std::nth_element(all_m.begin(), p95, all_m.end());
  found.front_p95_m = *p95;
  return found;
}

}  // namespace priamos::cli
