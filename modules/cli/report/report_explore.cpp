#include "cli/report/report_explore.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "cli/report/report_timeline.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {
namespace {

using Eigen::Vector2d;

constexpr double kStep_m = 0.1;
/// What the base keeps off everything on a route, and what it is to have seen of the floor from how far.
constexpr double kMargin_m = 0.10, kSight_m = 2.0;
/// The ring of sonars is so high.
constexpr double kRing_m = 0.4;
/// Walls are judged at places so far apart.
constexpr double kSample_m = 0.1;

bool Explores(const mission_command_t& order) {
  return order.mission == mission_command_t::EXPLORE;
}

std::vector<Rectangle> OutlinesAt(const TrueWorld& world, double low_m, double high_m) {
  std::vector<Rectangle> outlines;
  for (const world::Solid& solid : world.solids)
    if (solid.z_min_m < high_m && solid.z_max_m > low_m)
      outlines.push_back({solid.map_from_solid, solid.size_m / 2});
  return outlines;
}

/// The true floor in cells of 10 cm.
class TrueFloor {
 public:
  TrueFloor(const TrueWorld& world, const Vector2d& start, const Eigen::AlignedBox2d& around)
      : origin_(around.min()),
        nx_(static_cast<int>(std::ceil(around.sizes().x() / kStep_m))),
        ny_(static_cast<int>(std::ceil(around.sizes().y() / kStep_m))),
        gap_m_(std::size_t(nx_) * std::size_t(ny_), kFar_m),
        reachable_(gap_m_.size(), false),
        seen_(gap_m_.size(), false) {
    for (const Rectangle& outline : OutlinesAt(world, world.body.low_m, world.body.high_m)) Measure(outline);
    Flood(start, world.body.size_m.minCoeff() / 2 + kMargin_m);
    Widen(world.body.size_m.minCoeff() / 2);
  }

  void SeeFrom(const Vector2d& at) {
    constexpr int kRays = 160;
    for (int i = 0; i < kRays; ++i) {
      const double angle = 2 * kPi * i / kRays;
      for (double m = 0; m <= kSight_m; m += kStep_m / 2) {
        const int index = IndexAt(at + m * Vector2d(std::cos(angle), std::sin(angle)));
        if (index < 0 || gap_m_[std::size_t(index)] <= 0) break;
        seen_[std::size_t(index)] = true;
      }
    }
  }
  double reachable_m2() const {
    return kStep_m * kStep_m * double(std::count(reachable_.begin(), reachable_.end(), true));
  }
  double seen() const {
    std::size_t both = 0, all = 0;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      all += reachable_[i];
      both += reachable_[i] && seen_[i];
    }
    return all ? double(both) / double(all) : 0;
  }

 private:
  static constexpr float kFar_m = 1;

  Vector2d PlaceOf(int x, int y) const { return origin_ + kStep_m * Vector2d(x + 0.5, y + 0.5); }
  int IndexAt(const Vector2d& in_map) const {
    const Vector2d at = (in_map - origin_) / kStep_m;
    const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
    return x < 0 || y < 0 || x >= nx_ || y >= ny_ ? -1 : y * nx_ + x;
  }
  void Measure(const Rectangle& outline) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : outline.Corners()) box.extend(corner);
    const Vector2d low = (box.min() - origin_).array() / kStep_m - kFar_m / kStep_m,
                   high = (box.max() - origin_).array() / kStep_m + kFar_m / kStep_m;
    for (int y = std::max(0, int(low.y())); y < std::min(ny_, int(high.y()) + 1); ++y)
      for (int x = std::max(0, int(low.x())); x < std::min(nx_, int(high.x()) + 1); ++x) {
        float& gap_m = gap_m_[std::size_t(y * nx_ + x)];
        gap_m = std::min(gap_m, static_cast<float>(Distance(outline, PlaceOf(x, y))));
      }
  }
  /// Where the middle of a base gets that keeps `least_m` off everything.
  void Flood(const Vector2d& start, double least_m) {
    std::vector<int> open{IndexAt(start)};
    if (open.front() < 0) return;
    reachable_[std::size_t(open.front())] = true;
    while (!open.empty()) {
      const int at = open.back(), x = at % nx_, y = at / nx_;
      open.pop_back();
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int next = (y + dy) * nx_ + x + dx;
        if (x + dx < 0 || y + dy < 0 || x + dx >= nx_ || y + dy >= ny_) continue;
        if (reachable_[std::size_t(next)] || gap_m_[std::size_t(next)] < least_m) continue;
        reachable_[std::size_t(next)] = true;
        open.push_back(next);
      }
    }
  }
  /// From where its middle gets to what it covers.
  void Widen(double by_m) {
    const std::vector<bool> middle = reachable_;
    const int reach = static_cast<int>(by_m / kStep_m);
    for (int y = 0; y < ny_; ++y)
      for (int x = 0; x < nx_; ++x) {
        if (!middle[std::size_t(y * nx_ + x)]) continue;
        for (int dy = -reach; dy <= reach; ++dy)
          for (int dx = -reach; dx <= reach; ++dx) {
            const bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < nx_ && y + dy < ny_;
            const auto next = std::size_t((y + dy) * nx_ + x + dx);
            if (inside && std::hypot(dx, dy) * kStep_m <= by_m && gap_m_[next] > 0) reachable_[next] = true;
          }
      }
  }

  Vector2d origin_;
  int nx_, ny_;
  std::vector<float> gap_m_;  ///< to the nearest solid, 1 m at most
  std::vector<bool> reachable_, seen_;
};

/// A place on a wall as the planner has it, and to which side the base was.
struct WallPlace {
  Vector2d at, facing;
};

/// Places along the walls as the planner has them, every 10 cm.
std::vector<WallPlace> WallPlaces(const RunRecord& record) {
  std::map<std::pair<int, int>, feature_t> walls;  // as told last
  for (const features_t& message : record.features)
    for (const feature_t& feature : message.features) {
      if (feature.kind == feature_t::WALL)
        walls[{message.store, feature.id}] = feature;
      else
        walls.erase({message.store, feature.id});
    }
  std::vector<WallPlace> places;
  for (const auto& [name, wall] : walls) {
    const Pose2 map_from_wall{wall.x_m, wall.y_m, wall.yaw_rad};
    for (double at_m = -wall.length_m / 2; at_m <= wall.length_m / 2; at_m += kSample_m)
      places.push_back({map_from_wall * Vector2d(at_m, 0), map_from_wall.rotation() * Vector2d::UnitY()});
  }
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
      const Vector2d from = corners[i], line = corners[(i + 1) % corners.size()] - from;
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
  Eigen::AlignedBox2d around(start);
  for (const Rectangle& outline : OutlinesAt(info.world, 0, 1))
    for (const Vector2d& corner : outline.Corners()) around.extend(corner);
  TrueFloor floor(info.world, start, around);
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

}  // namespace priamos::cli
