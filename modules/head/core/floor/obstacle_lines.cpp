#include "head/core/floor/obstacle_lines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/image_size.hpp"
#include "head/core/floor/floor_fit.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kNearest_m = 0.2, kFarthest_m = 8;
constexpr double kMinSine = 0.02;  ///< sine of the smallest angle between line of sight and plane of light
constexpr double kGap_px = 4;      ///< widest gap within a piece, in columns
constexpr double kStraight_m = 0.015;  ///< largest deviation of a piece from a straight line
constexpr double kScaleError = 0.01;   ///< relative error of an obstacle's height
constexpr double kSpan_m = 3;          ///< to either side, where the floor's line is looked for
constexpr double kRowMargin_px = 14;

/// Where lines of sight meet the plane of the light.
class Triangulation {
 public:
  Triangulation(const CameraModel& camera, const LaserPlane& laser)
      : camera_(camera),
        normal_(laser.normal),
        ray_from_image_(camera.image_from_base.leftCols<3>().inverse()),
        eye_(-ray_from_image_ * camera.image_from_base.col(3)),
        distance_(laser.normal.dot(eye_) + laser.offset_m) {}

  struct Point {
    Vector3d at;
    double rise_m_per_px;   ///< change of its height with the row
    double rise_per_shift;  ///< and with a shift of the plane along its normal
  };
  std::optional<Point> At(const Vector2d& image_px) const {
    const Vector3d ray = ray_from_image_ * camera_.Undistort(image_px).homogeneous();
    const double slope = normal_.dot(ray), range = -distance_ / slope;
    if (!(std::abs(slope) > kMinSine * ray.norm()) || !(range > 0)) return std::nullopt;
    const Vector3d by_row = ray_from_image_.col(1);
    const Vector3d moved = range * (by_row - ray * (normal_.dot(by_row) / slope));
    return Point{eye_ + range * ray, moved.z(), ray.z() / slope};
  }

 private:
  const CameraModel& camera_;
  Vector3d normal_;
  Eigen::Matrix3d ray_from_image_;
  Vector3d eye_;
  double distance_;
};

struct Light {
  std::vector<LightPoint> points;
  double rise_m_per_px = 0, rise_per_shift = 0;  ///< root mean square
};

Light Triangulate(std::span<const StripePoint> stripe, const CameraModel& camera, const LaserPlane& laser,
                  const ObstacleOptions& options) {
  const Triangulation triangulation(camera, laser);
  Light light;
  light.points.reserve(stripe.size());
  const double rough2 = options.floor.rough_m * options.floor.rough_m;
  for (const StripePoint& s : stripe) {
    const auto point = triangulation.At(s.at);
    if (!point || point->at.x() < kNearest_m || point->at.x() > kFarthest_m) continue;
    if (point->at.z() < options.lowest_m || point->at.z() > options.highest_m) continue;
    const double sigma = point->rise_m_per_px * s.sigma_px;
    light.points.push_back({s.at.x(), point->at, sigma * sigma + rough2});
    light.rise_m_per_px += point->rise_m_per_px * point->rise_m_per_px;
    light.rise_per_shift += point->rise_per_shift * point->rise_per_shift;
  }
  const double n = std::max<double>(1, static_cast<double>(light.points.size()));
  light.rise_m_per_px = std::sqrt(light.rise_m_per_px / n);
  light.rise_per_shift = std::sqrt(light.rise_per_shift / n);
  return light;
}

/// Prior covariance of the floor; errors of camera and laser act like heave and roll of it.
Eigen::Matrix3d FloorPrior(const FloorTolerance& floor, const LaserPlane& laser, const Light& light) {
  const double camera = light.rise_m_per_px * floor.camera_px;
  const double shift = light.rise_per_shift * laser.sigma_shift_m;
  const double turn = light.rise_per_shift * laser.sigma_turn_rad;
  return Vector3d(floor.heave_m * floor.heave_m + camera * camera + shift * shift,
                  floor.pitch_rad * floor.pitch_rad + turn * turn,
                  floor.roll_rad * floor.roll_rad + turn * turn)
      .asDiagonal();
}

using Run = std::span<const LightPoint>;

/// Neighbouring points that leave the floor to the same side.
std::vector<Run> RunsOffFloor(const std::vector<LightPoint>& points, const FloorPlane& floor,
                              const ObstacleOptions& options) {
  std::vector<Run> runs;
  std::size_t first = 0, last = 0;
  double sign = 0;
  const auto close = [&] {
    if (sign != 0) runs.push_back(Run(points).subspan(first, last - first + 1));
    sign = 0;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double height = floor.HeightOf(points[i].at);
    const bool off = std::abs(height) > std::max(options.min_height_m / 2, 3 * std::sqrt(points[i].variance));
    if (sign != 0 && (points[i].u - points[last].u > kGap_px || (off && height * sign < 0))) close();
    if (!off) continue;
    if (sign == 0) {
      first = i;
      sign = height;
    }
    last = i;
  }
  close();
  return runs;
}

/// Cuts a run where it bends, as Ramer, Douglas and Peucker do.
void CutStraight(Run run, std::vector<Run>& straight) {
  const Vector3d &begin = run.front().at, &end = run.back().at;
  const Vector3d direction = (end - begin).normalized();
  double farthest = kStraight_m;
  std::size_t cut = 0;
  for (std::size_t i = 1; i + 1 < run.size(); ++i) {
    const Vector3d offset = run[i].at - begin;
    const double distance = direction.allFinite() ? offset.cross(direction).norm() : offset.norm();
    if (distance > farthest) {
      farthest = distance;
      cut = i;
    }
  }
  if (cut == 0) return straight.push_back(run);
  CutStraight(run.first(cut), straight);
  CutStraight(run.subspan(cut), straight);
}

/// The obstacle piece that a run of points shows; nullopt if it is too short, too low or not significant.
std::optional<ObstaclePiece> Judge(Run run, const FloorPlane& floor, const ObstacleOptions& options) {
  if (run.size() < static_cast<std::size_t>(options.min_columns)) return std::nullopt;
  Vector3d mean = Vector3d::Zero();
  double height = 0, variance = 0;
  const double n = static_cast<double>(run.size());
  for (const LightPoint& p : run) {
    mean += p.at / n;
    height += floor.HeightOf(p.at) / n;
    variance += p.variance / n;
  }
  const double scale = kScaleError * height;
  const double sigma =
      std::sqrt(variance / std::max(1.0, n / kColumnsPerFact) + floor.VarianceAt(mean) + scale * scale);
  if (std::abs(height) < options.min_height_m || std::abs(height) < options.significance * sigma)
    return std::nullopt;
  return ObstaclePiece{height > 0 ? ObstaclePiece::kUp : ObstaclePiece::kDown, run.back().at, run.front().at,
                       height, sigma};
}

/// Where the light meets the floor, by column.
class FloorLine {
 public:
  FloorLine(const CameraModel& camera, const LaserPlane& laser, const FloorPlane& floor) {
    const Vector3d& n = laser.normal;
    for (double y = kSpan_m; y >= -kSpan_m; y -= 0.05) {
      // n.(x, y, z) + offset = 0 with z = a + b x + c y.
      const double x = -(n.y() * y + n.z() * (floor.plane[0] + floor.plane[2] * y) + laser.offset_m) /
                       (n.x() + n.z() * floor.plane[1]);
      const Vector3d at(x, y, floor.plane.dot(Vector3d(1, x, y)));
      if (!at.allFinite() || x < kNearest_m || x > kFarthest_m || camera.Depth(at) < 0.1) continue;
      const double u = camera.Distort(camera.Project(at)).x();
      if (columns_.empty() || u > columns_.back().first) columns_.emplace_back(u, at);
    }
  }
  std::optional<Vector3d> At(double u) const {
    const auto after = std::lower_bound(columns_.begin(), columns_.end(), u,
                                        [](const auto& c, double value) { return c.first < value; });
    if (after == columns_.begin() || after == columns_.end()) return std::nullopt;
    const auto before = after - 1;
    const double share = (u - before->first) / (after->first - before->first);
    return Vector3d(before->second + share * (after->second - before->second));
  }

 private:
  std::vector<std::pair<double, Vector3d>> columns_;
};

void AddMissing(double from_u, double to_u, const FloorLine& line, std::vector<ObstaclePiece>& pieces) {
  const auto left = line.At(from_u), right = line.At(to_u);
  if (left && right) pieces.push_back({ObstaclePiece::kMissing, *right, *left, 0, 0});
}

void FindMissing(const std::vector<LightPoint>& points, int width, const CameraModel& camera,
                 const LaserPlane& laser, const FloorPlane& floor, int min_missing,
                 std::vector<ObstaclePiece>& pieces) {
  std::vector<std::pair<double, double>> gaps;
  double last = -1;
  for (const LightPoint& p : points) {
    if (p.u - last > min_missing) gaps.emplace_back(last + 1, p.u - 1);
    last = p.u;
  }
  if (width - last > min_missing) gaps.emplace_back(last + 1, width - 1);
  if (gaps.empty()) return;
  const FloorLine line(camera, laser, floor);
  for (const auto& [from, to] : gaps) AddMissing(from, to, line, pieces);
}

}  // namespace

void FloorTolerance::Describe(Archive& a) {
  a.Number("heave_m", heave_m, {"m", 0.0001, 0.1, "up and down below the robot, joints included; 1 sigma"});
  a.Number("pitch_rad", pitch_rad, {"rad", 0.0001, 0.1, "angle by which the robot nods; 1 sigma"});
  a.Number("roll_rad", roll_rad, {"rad", 0.0001, 0.1, "angle by which the robot heels; 1 sigma"});
  a.Number("rough_m", rough_m, {"m", 0.0001, 0.05, "roughness of the surface, from place to place; 1 sigma"});
  a.Number("camera_px", camera_px, {"px", 0.01, 5, "how well the third camera is calibrated; 1 sigma"});
}

void ObstacleOptions::Describe(Archive& a) {
  a.Number("min_height_m", min_height_m, {"m", 0.003, 0.2, "what is lower is driven over"});
  a.Number("lowest_m", lowest_m, {"m", -3, -0.01, "deepest that is looked for, against the floor"});
  a.Number("highest_m", highest_m, {"m", 0.01, 3, "highest that is looked for"});
  a.Number("significance", significance, {"-", 3, 20, "sigmas of its height that an obstacle needs"});
  a.Integer("min_columns", min_columns, {"px", 4, 200, "columns of the picture that it needs"});
  a.Integer("min_missing", min_missing,
            {"px", 4, ImageSize{}.width, "a gap in the line is reported if it has more columns"});
  a.Number("min_seen", min_seen,
           {"-", 0, 1, "least share of columns with a line; with less the floor is not judged"});
  // Last: as TOML, what followed would belong to it.
  a.Section("floor", floor, "how a floor may lie");
}

ObstacleLines FindObstacles(std::span<const StripePoint> stripe, int width, const CameraModel& camera,
                            const LaserPlane& laser, const ObstacleOptions& options) {
  const Light light = Triangulate(stripe, camera, laser, options);
  const FloorPlane floor = FitFloor(light.points, FloorPrior(options.floor, laser, light));
  ObstacleLines result;
  result.seen_share = width > 0 ? static_cast<double>(light.points.size()) / width : 0;
  result.floor = floor.plane;
  result.floor_covariance = floor.covariance;
  std::vector<Run> straight;
  for (const Run run : RunsOffFloor(light.points, floor, options)) CutStraight(run, straight);
  for (const Run run : straight) {
    if (const auto piece = Judge(run, floor, options)) result.pieces.push_back(*piece);
  }
  result.verdict = !result.pieces.empty()                 ? ObstacleLines::kObstacle
                   : result.seen_share < options.min_seen ? ObstacleLines::kBlind
                                                          : ObstacleLines::kClear;
  FindMissing(light.points, width, camera, laser, floor, options.min_missing, result.pieces);
  std::stable_sort(result.pieces.begin(), result.pieces.end(),
                   [](const auto& a, const auto& b) { return a.right.y() < b.right.y(); });
  return result;
}

RowRange LineRows(const CameraModel& camera, const LaserPlane& laser, int width, int height,
                  const ObstacleOptions& options) {
  double first = 1e9, last = -1e9;
  for (int step = 0; step <= 10; ++step) {
    const double z = options.lowest_m + step / 10.0 * (options.highest_m - options.lowest_m);
    for (double y = -kSpan_m; y <= kSpan_m; y += 0.25) {
      const Vector3d at(-(laser.normal.y() * y + laser.normal.z() * z + laser.offset_m) / laser.normal.x(), y,
                        z);
      if (!at.allFinite() || at.x() < kNearest_m || at.x() > kFarthest_m || camera.Depth(at) < 0.1) continue;
      const Vector2d image = camera.Project(at);
      if (image.x() < -0.1 * width || image.x() > 1.1 * width) continue;
      const Vector2d distorted = camera.Distort(image);
      if (distorted.y() < -0.5 * height || distorted.y() > 1.5 * height) continue;
      first = std::min(first, distorted.y());
      last = std::max(last, distorted.y());
    }
  }
  const RowRange rows{static_cast<int>(std::max(0.0, first - kRowMargin_px)),
                      static_cast<int>(std::min<double>(height - 1, last + kRowMargin_px))};
  return rows.first < rows.last ? rows : RowRange{};
}

ObstacleLines ObstacleFinder::Find(const GreyImage& picture, const CameraModel& camera,
                                   const LaserPlane& laser) {
  const RowRange rows = LineRows(camera, laser, picture.width, picture.height, options_);
  if (rows.first > rows.last) return {};
  const auto row = [&](int v) {
    return picture.pixels.begin() + static_cast<std::ptrdiff_t>(v) * picture.width;
  };
  band_.width = picture.width;
  band_.height = rows.last - rows.first + 1;
  band_.pixels.assign(row(rows.first), row(rows.last + 1));
  std::vector<StripePoint> stripe = stripe_.Find(band_);
  for (StripePoint& p : stripe) p.at.y() += rows.first;
  return FindObstacles(stripe, picture.width, camera, laser, options_);
}

}  // namespace priamos::head
