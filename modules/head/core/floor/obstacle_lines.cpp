#include "head/core/floor/obstacle_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "head/core/floor/floor_fit.hpp"
#include "head/core/floor/line_geometry.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;

constexpr double kGap_px = 4;          ///< widest gap within a piece, in columns
constexpr double kStraight_m = 0.015;  ///< largest deviation of a piece from a straight line
constexpr double kScaleError = 0.01;   ///< relative error of an obstacle's height

/// The points of all lines in space.
struct Light {
  std::vector<LightPoint> points;                   ///< line after line
  double camera2_m2 = 0, shift2_m2 = 0, turn2 = 0;  ///< mean squares of what errors of calibration do
};

void Triangulate(const SeenLine& line, int number, const CameraModel& camera, const ObstacleOptions& options,
                 Light& light) {
  const Triangulation triangulation(camera, line.plane);
  const LaserPlane& laser = line.plane;
  const double rough2 = options.floor.rough_m * options.floor.rough_m;
  for (const StripePoint& s : line.points) {
    const auto point = triangulation.At(s.at);
    if (!point || point->at.x() < kNearestLight_m || point->at.x() > kFarthestLight_m) continue;
    if (point->at.z() < options.lowest_m || point->at.z() > options.highest_m) continue;
    const auto square = [](double x) { return x * x; };
    const double by_shift = square(point->rise_per_shift);
    LightPoint in_space{s.at.x(), point->at, square(point->rise_m_per_px * s.sigma_px) + rough2, number};
    in_space.laser_variance =
        by_shift * (square(laser.sigma_shift_m) +
                    square(laser.sigma_turn_rad) * (point->at - laser.pivot_m).squaredNorm());
    light.points.push_back(in_space);
    light.camera2_m2 += square(point->rise_m_per_px * options.floor.camera_px);
    light.shift2_m2 += by_shift * square(laser.sigma_shift_m);
    light.turn2 += by_shift * square(laser.sigma_turn_rad);
  }
}

Light Triangulate(std::span<const SeenLine> lines, const CameraModel& camera,
                  const ObstacleOptions& options) {
  Light light;
  for (std::size_t k = 0; k < lines.size(); ++k)
    Triangulate(lines[k], static_cast<int>(k), camera, options, light);
  const double n = std::max<double>(1, static_cast<double>(light.points.size()));
  light.camera2_m2 /= n;
  light.shift2_m2 /= n;
  light.turn2 /= n;
  return light;
}

/// Prior covariance of the floor; errors of camera and laser act like heave and roll of it.
Eigen::Matrix3d FloorPrior(const FloorTolerance& floor, const Light& light) {
  return Vector3d(floor.heave_m * floor.heave_m + light.camera2_m2 + light.shift2_m2,
                  floor.pitch_rad * floor.pitch_rad + light.turn2,
                  floor.roll_rad * floor.roll_rad + light.turn2)
      .asDiagonal();
}

using Run = std::span<const LightPoint>;

/// Neighbouring points that leave the floor to the same side.
std::vector<Run> RunsOffFloor(Run points, const FloorPlane& floor, const ObstacleOptions& options) {
  std::vector<Run> runs;
  std::size_t first = 0, last = 0;
  double sign = 0;
  const auto close = [&] {
    if (sign != 0) runs.push_back(points.subspan(first, last - first + 1));
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
/// `against_others`: the floor is known from other lines as well, with errors of their own.
std::optional<ObstaclePiece> Judge(Run run, const FloorPlane& floor, bool against_others,
                                   const ObstacleOptions& options) {
  if (run.size() < static_cast<std::size_t>(options.min_columns)) return std::nullopt;
  Vector3d mean = Vector3d::Zero();
  double height = 0, variance = 0, laser = 0;
  const double n = static_cast<double>(run.size());
  for (const LightPoint& p : run) {
    mean += p.at / n;
    height += floor.HeightOf(p.at) / n;
    variance += p.variance / n;
    if (against_others) laser += p.laser_variance / n;
  }
  const double scale = kScaleError * height;
  const double sigma = std::sqrt(variance / std::max(1.0, n / kColumnsPerFact) + floor.VarianceAt(mean) +
                                 laser + scale * scale);
  if (std::abs(height) < options.min_height_m || std::abs(height) < options.significance * sigma)
    return std::nullopt;
  return ObstaclePiece{height > 0 ? ObstaclePiece::kUp : ObstaclePiece::kDown, run.back().at, run.front().at,
                       height, sigma};
}

void AddMissing(double from_u, double to_u, const FloorLine& line, std::vector<ObstaclePiece>& pieces) {
  const auto left = line.At(from_u), right = line.At(to_u);
  if (left && right) pieces.push_back({ObstaclePiece::kMissing, right->at, left->at, 0, 0});
}

/// Of the columns in which the line should be.
void FindMissing(Run points, const SeenLine& line, const CameraModel& camera, const FloorPlane& floor,
                 int min_missing, std::vector<ObstaclePiece>& pieces) {
  const auto& row = line.expected.row;
  double first = 0, last = static_cast<double>(row.size()) - 1;
  while (first < last && !row[static_cast<std::size_t>(first)]) ++first;
  while (last > first && !row[static_cast<std::size_t>(last)]) --last;
  std::vector<std::pair<double, double>> gaps;
  double before = first - 1;
  for (const LightPoint& p : points) {
    if (p.u - before > min_missing) gaps.emplace_back(before + 1, p.u - 1);
    before = p.u;
  }
  if (last + 1 - before > min_missing) gaps.emplace_back(before + 1, last);
  if (gaps.empty()) return;
  const FloorLine on_floor(camera, line.plane, floor.plane);
  for (const auto& [from, to] : gaps) AddMissing(from, to, on_floor, pieces);
}

/// The points of one line.
Run PointsOf(const std::vector<LightPoint>& points, int line) {
  const auto first = std::ranges::lower_bound(points, line, {}, &LightPoint::line);
  return {first, std::ranges::upper_bound(first, points.end(), line, {}, &LightPoint::line)};
}

/// The pieces of one line that are not on the floor, and those that are missing.
std::vector<ObstaclePiece> PiecesOf(Run points, const SeenLine& line, bool against_others,
                                    const CameraModel& camera, const FloorPlane& floor,
                                    const ObstacleOptions& options) {
  std::vector<Run> straight;
  for (const Run run : RunsOffFloor(points, floor, options)) CutStraight(run, straight);
  std::vector<ObstaclePiece> pieces;
  for (const Run run : straight) {
    if (const auto piece = Judge(run, floor, against_others, options)) pieces.push_back(*piece);
  }
  FindMissing(points, line, camera, floor, options.min_missing, pieces);
  for (ObstaclePiece& piece : pieces) piece.laser = static_cast<int>(line.expected.laser);
  return pieces;
}

}  // namespace

ObstacleLines FindObstacles(std::span<const SeenLine> lines, const CameraModel& camera,
                            const ObstacleOptions& options) {
  const Light light = Triangulate(lines, camera, options);
  const FloorPlane floor = FitFloor(light.points, FloorPrior(options.floor, light));
  ObstacleLines result;
  result.floor = floor.plane;
  result.floor_covariance = floor.covariance;
  double columns = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Run points = PointsOf(light.points, static_cast<int>(k));
    columns += lines[k].expected.columns;
    for (const ObstaclePiece& piece : PiecesOf(points, lines[k], lines.size() > 1, camera, floor, options))
      result.pieces.push_back(piece);
  }
  result.seen_share = columns > 0 ? std::min(1.0, static_cast<double>(light.points.size()) / columns) : 0;
  const bool obstacle = std::ranges::any_of(
      result.pieces, [](const ObstaclePiece& p) { return p.kind != ObstaclePiece::kMissing; });
  result.verdict = obstacle                               ? ObstacleLines::kObstacle
                   : result.seen_share < options.min_seen ? ObstacleLines::kBlind
                                                          : ObstacleLines::kClear;
  std::ranges::stable_sort(result.pieces, {}, [](const ObstaclePiece& p) { return p.right.y(); });
  return result;
}

std::vector<std::vector<StripePoint>> ObstacleFinder::FindStripes(const GreyImage& picture,
                                                                  std::span<const ExpectedLine> lines) {
  int first = picture.height, last = -1;
  for (const ExpectedLine& line : lines) {
    first = std::min(first, line.rows.first);
    last = std::max(last, line.rows.last);
  }
  const auto row = [&](int v) {
    return picture.pixels.begin() + static_cast<std::ptrdiff_t>(v) * picture.width;
  };
  band_.width = picture.width;
  band_.height = last - first + 1;
  band_.pixels.assign(row(first), row(last + 1));
  std::vector<StripePoint> ridges = stripe_.Ridges(band_, static_cast<int>(lines.size()));
  for (StripePoint& p : ridges) p.at.y() += first;
  return TellApart(ridges, lines);
}

ObstacleLines ObstacleFinder::Find(const GreyImage& picture, const CameraModel& camera,
                                   std::span<const LaserPlane> lasers) {
  const auto lines = ExpectLines(camera, lasers, {picture.width, picture.height}, options_);
  if (lines.empty()) return {};
  auto stripes = FindStripes(picture, lines);
  std::vector<SeenLine> seen;
  for (std::size_t k = 0; k < lines.size(); ++k)
    seen.push_back({lasers[lines[k].laser], lines[k], stripe_.Trace(std::move(stripes[k]))});
  return FindObstacles(seen, camera, options_);
}

}  // namespace priamos::head
