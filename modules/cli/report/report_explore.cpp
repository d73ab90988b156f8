#include "cli/report/report_explore.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cli/floor/floor_tour.hpp"
#include "cli/floor/true_floor.hpp"
#include "cli/report/report_timeline.hpp"
#include "common/learned/edge_walls.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {
namespace {

using Eigen::Vector2d;

/// Between two places from which the base sees.
constexpr double kStep_m = 0.1;
/// The ring of sonars is so high.
constexpr double kRing_m = 0.4;
/// Walls are judged at places so far apart.
constexpr double kSample_m = 0.1;

bool Explores(const mission_command_t& order) {
  return order.mission == mission_command_t::EXPLORE;
}

/// A place on a wall as the planner has it, and to which side the base was.
struct WallPlace {
  Vector2d at, facing;
};

LearnedWall WallFrom(const floor_wall_t& line) {
  const Vector2d from(line.x1_m, line.y1_m), to(line.x2_m, line.y2_m);
  LearnedWall wall;
  wall.x_m = (from.x() + to.x()) / 2;
  wall.y_m = (from.y() + to.y()) / 2;
  wall.yaw_deg = Degrees(std::atan2(to.y() - from.y(), to.x() - from.x()));
  wall.length_m = (to - from).norm();
  return wall;
}

/// Places along the walls as the planner has them, every 10 cm; what counts as the edge of a wall is none.
std::vector<WallPlace> WallPlaces(const RunRecord& record) {
  LearnedWalls known;
  for (const floor_map_t& part : record.map)
    for (const floor_wall_t& line : part.walls) known.walls.push_back(WallFrom(line));
  std::vector<WallPlace> places;
  constexpr double kRounding_m = 1e-3;  // lines travel as floats
  for (const LearnedWall& wall : WithoutEdges(known).walls)
    for (double at_m = -wall.length_m / 2; at_m < wall.length_m / 2 - kRounding_m; at_m += kSample_m)
      places.push_back({wall.At(at_m), wall.map_from_wall().rotation() * Vector2d::UnitY()});
  return places;
}

/// The nearest point of a true face, and to where the face looks.
struct FacePoint {
  Vector2d from_place{1e3, 0}, outward{1, 0};
};

/// Of the faces that look the same way as a place, by 45 degrees: the back of a wall is none that was heard
/// from its front.
FacePoint NearestFace(const std::vector<Rectangle>& outlines, const WallPlace& place) {
  const Vector2d& at = place.at;
  FacePoint best;
  for (const Rectangle& outline : outlines) {
    const auto corners = outline.Corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2d& from = corners[i];
      const Vector2d line = corners[(i + 1) % corners.size()] - from;
      Vector2d outward = Vector2d(line.y(), -line.x()).normalized();
      if (outward.dot(from - outline.map_from_centre.translation()) < 0) outward = -outward;
      if (outward.dot(place.facing) < std::cos(kPi / 4)) continue;
      const double part = std::clamp((at - from).dot(line) / std::max(1e-12, line.squaredNorm()), 0.0, 1.0);
      const Vector2d to = from + part * line - at;
      if (to.squaredNorm() < best.from_place.squaredNorm()) best = {to, outward};
    }
  }
  return best;
}

std::vector<WallPlace> Moved(const Pose2& to_from_here, std::vector<WallPlace> places) {
  for (WallPlace& place : places) place = {to_from_here * place.at, to_from_here.rotation() * place.facing};
  return places;
}

/// The 95 % quantile of the distance to the truth after the turn and shift that fit best, found step by step
/// from the lines of the nearest faces (Chen and Medioni 1992); what is more than half a metre off does not
/// pull.
double ErrorAfterFit(const std::vector<Rectangle>& outlines, std::vector<WallPlace> places) {
  constexpr int kSteps = 15;
  constexpr double kPulls_m = 0.5;
  std::vector<double> errors;
  for (int step = 0; step <= kSteps && !places.empty(); ++step) {
    errors.clear();
    Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const WallPlace& place : places) {
      const FacePoint face = NearestFace(outlines, place);
      errors.push_back(face.from_place.norm());
      if (errors.back() > kPulls_m) continue;
      const Vector2d &across = face.outward, &at = place.at;
      const Eigen::Vector3d row(across.x(), across.y(), across.y() * at.x() - across.x() * at.y());
      normal += row * row.transpose();
      right += row * across.dot(face.from_place);
    }
    const Eigen::Vector3d by = normal.ldlt().solve(right);
    if (step < kSteps) places = Moved({by.x(), by.y(), by.z()}, std::move(places));
  }
  if (errors.empty()) return 0;
  const auto at = errors.begin() + std::ptrdiff_t(0.95 * double(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  return *at;
}

}  // namespace

std::optional<ExploreSummary> ExploreSummaryOf(const RunRecord& record, const RunInfo& info) {
  if (std::none_of(record.orders.begin(), record.orders.end(), Explores)) return std::nullopt;
  ExploreSummary summary;
  summary.end = info.reason;
  if (record.truth.empty() || record.poses.empty()) return summary;
  const Vector2d start(record.truth.front().x_m, record.truth.front().y_m);
  TrueFloor floor(info.world, start);
  Vector2d last = start;
  floor.SeeFrom(last);
  for (const world_truth_t& truth : record.truth) {
    const Vector2d at(truth.x_m, truth.y_m);
    if ((at - last).norm() < kStep_m) continue;
    summary.driven_m += (at - last).norm();
    floor.SeeFrom(at);
    last = at;
  }
  summary.reachable_m2 = floor.reachable_m2();
  summary.seen = floor.seen();
  const FloorTour tour = TourOf(floor, start);
  summary.tour_m = tour.length_m;
  summary.tour_places = tour.places;
  const pose_t &first = record.poses.front(), &newest = record.poses.back();
  const auto begun = TruthAt(record, first.utime), ended = TruthAt(record, newest.utime);
  if (!begun || !ended) return summary;
  const Pose2 true_from_map = *begun * Pose2{first.x_m, first.y_m, first.yaw_rad}.Inverse();
  const Pose2 off = ended->Inverse() * (true_from_map * Pose2{newest.x_m, newest.y_m, newest.yaw_rad});
  summary.pose_error_m = off.translation().norm();
  summary.pose_error_deg = std::abs(Degrees(off.yaw));
  auto places = Moved(true_from_map, WallPlaces(record));
  summary.wall_m = kSample_m * double(places.size());
  summary.wall_error_p95_m = ErrorAfterFit(OutlinesAt(info.world, kRing_m, kRing_m), std::move(places));
  return summary;
}

std::string SeenText(const ExploreSummary& explore) {
  return fmt::format("seen {:.1f} % of {:.1f} m2", 100 * explore.seen, explore.reachable_m2);
}

std::string FaultOf(const ExploreSummary& explore, double least_seen) {
  if (explore.seen >= least_seen) return "";
  return fmt::format("{} that can be reached, {:.1f} % are asked; {}", SeenText(explore), 100 * least_seen,
                     explore.end);
}

}  // namespace priamos::cli
