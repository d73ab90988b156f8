#include "head/core/doors/outline_evidence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "head/core/stereo/plan_line.hpp"

namespace priamos::head {
namespace {

constexpr double kUsualCamera_m = 1.25, kUsualLintel_m = 2.05;  ///< scale at which frames are looked for
constexpr double kSameDrop = 0.05;  ///< a level line of the wall is so level, as a share
constexpr double kSameWall_rad = 0.025;
constexpr double kFarthestBeside = 1.5;  ///< widths
constexpr double kFoot_m = 0.05;         ///< feet are seen so exactly
constexpr double kFarthestFoot_m = 0.6;  ///< farther off they tell no more
constexpr double kStanding_m = 0.12, kHanging_m = 0.15;

double EndOdds(double px, double share) {
  constexpr double kSigma_px = 2.5, kReach_px = 50;
  const double normal = std::exp(-0.5 * px * px / (kSigma_px * kSigma_px)) / (2.507 * kSigma_px);
  return std::log(share * normal * kReach_px + 1 - share);
}

/// Where the sight along `ray` (from above) meets the outline's wall: 0 at the left, 1 at the right upright.
std::optional<double> AlongWall(const DoorOutline& outline, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d left = outline.At(0), across = outline.At(1) - left;
  Eigen::Matrix2d m;
  m << ray, -across;
  if (std::abs(m.determinant()) < 1e-6) return std::nullopt;
  const Eigen::Vector2d solved = m.inverse() * left;  // distance along the ray, place along the wall
  if (solved[0] <= 0) return std::nullopt;
  return solved[1];
}

std::optional<WallLine> OnWall(const DoorOutline& outline, const ViewLine& line,
                               const Eigen::Matrix3d& rays) {
  std::array<double, 2> drop;
  for (int i = 0; i < 2; ++i)
    drop[i] = line.plane.head<2>().dot(outline.bearings[i]) / (line.plane.z() * outline.rises[i]);
  const double mean = (drop[0] + drop[1]) / 2;
  if (mean < 0.05 || mean > 20 || std::abs(drop[0] - drop[1]) > kSameDrop * mean) return std::nullopt;
  const auto p = AlongWall(outline, (rays * line.p.homogeneous()).head<2>()),
             q = AlongWall(outline, (rays * line.q.homogeneous()).head<2>());
  if (!p || !q) return std::nullopt;
  const double from = std::max(std::min(*p, *q), -kFarthestBeside),
               to = std::min(std::max(*p, *q), 1 + kFarthestBeside);
  if (from >= to) return std::nullopt;
  const double within = std::max(0.0, std::min(to, 1.0) - std::max(from, 0.0));
  return WallLine{mean, to - from - within, within};
}

double AlongWalls(const CameraView& view, const DoorOutline& outline) {
  const Eigen::Vector2d across = (outline.At(1) - outline.At(0)).normalized();
  const ViewLine& own = view.lines[outline.lintel];
  double length = 0;
  for (const ViewLine& line : view.lines) {
    if (!IsLevel(line)) continue;
    const Eigen::Vector2d normal = line.plane.head<2>();
    const double planar = normal.norm();
    if (planar < 0.1 || std::abs(normal.dot(across)) > kSameWall_rad * planar) continue;
    if (std::abs(own.normal.dot((line.p + line.q) / 2 - own.p)) < 0.15 * own.length_px) continue;
    length += line.length_px;
  }
  return length;
}

/// Whether a level line leads from the corner outwards, across the wall.
bool IsBoxCorner(const CameraView& view, const DoorOutline& outline, int side) {
  constexpr double kLeast_px = 14, kAcross_rad = 0.6, kRim = 0.14;
  const Eigen::Vector3d level(outline.bearings[side].x(), outline.bearings[side].y(), 0);
  const double above_px =
      (outline.corners[side] - (view.camera->image_from_base.leftCols<3>() * level).hnormalized()).norm();
  const double near_px = std::max(7.0, kRim * above_px);
  const Eigen::Vector2d &corner = outline.corners[side],
                        out = (corner - outline.corners[1 - side]).normalized();
  const Eigen::Vector2d across = (outline.At(1) - outline.At(0)).normalized();
  for (const ViewLine& line : view.lines) {
    if (line.length_px < kLeast_px || !IsLevel(line)) continue;
    const bool from_p = (line.p - corner).norm() < (line.q - corner).norm();
    const Eigen::Vector2d &near = from_p ? line.p : line.q, &far = from_p ? line.q : line.p;
    if ((near - corner).norm() > near_px || out.dot(far - corner) < 0.5 * line.length_px) continue;
    const Eigen::Vector2d normal = line.plane.head<2>();
    if (std::abs(normal.dot(across)) > std::sin(kAcross_rad) * normal.norm()) return true;
  }
  return false;
}

/// What speaks for and against a door; each number has its weight in kWeights.
struct Features {
  double lintel = 0;             ///< covered share
  double lintel_ends = 0;        ///< log odds that they are at the corners
  double uprights = 0;           ///< covered shares, of both
  double upright_ends = 0;       ///< log odds that the upper ones are at the corners
  double weaker = 0;             ///< covered share of the upright that is covered less
  double hangs = 0;              ///< height of lower ends above the floor [m], of both
  double deep = 0;               ///< depth of lower ends below it [m], of both
  double standing = 0;           ///< number of uprights that end at the floor
  double out_of_sight = 0;       ///< number of uprights that end at the border of the picture
  double sill = 0;               ///< share of a level edge between lower ends that hang
  double border = 0;             ///< share of a level line of the wall between the uprights, above the floor
  double frame_lintel = 0;       ///< share of a second lintel, up to a half
  double whole_lintel = 0;       ///< the rest of it
  double frame_upright = 0;      ///< share of a second upright
  double width = 0, height = 0;  ///< squared deviations from the usual ones
  double floor_beside = 0;       ///< lines where the wall meets the floor, beside the outline [widths]
  double below = 0;              ///< the same for lines farther down
  double wall = 0;               ///< logarithm of the length of level lines along the wall
  double box = 0;                ///< corners of a box
};

void AddFeet(const DoorOutline& outline, const OutlineEvidence& e, double above_m, double drop, Features& f) {
  std::array<double, 2> share;
  double both_hang_m = 10;
  for (int i = 0; i < 2; ++i) {
    const bool inside = outline.foot_inside[i];
    const double low = outline.falls[i] / outline.rises[i];  // the lower end, like `drop`
    const double hangs_m = above_m * (drop - low);
    share[i] = outline.covered[i] * std::min(1.0, (1 + low) / (1 + (inside ? drop : low)));
    if (inside) f.hangs += std::clamp(hangs_m - kFoot_m, 0.0, kFarthestFoot_m);
    f.deep += std::clamp(-hangs_m - kFoot_m, 0.0, kFarthestFoot_m);
    f.standing += inside && std::abs(hangs_m) < kStanding_m;
    f.out_of_sight += !inside;
    f.upright_ends += EndOdds(outline.first_px[i], 0.8);
    both_hang_m = std::min(both_hang_m, inside ? hangs_m : 0);
  }
  f.uprights = share[0] + share[1];
  f.weaker = std::min(share[0], share[1]);
  f.sill = both_hang_m > kHanging_m ? e.edges.sill : 0;
}

void AddWall(const OutlineEvidence& e, double drop, Features& f) {
  for (const WallLine& line : e.wall_lines) {
    const double ratio = line.drop / drop;
    if (ratio > 0.88 && ratio < 1.04) f.floor_beside += line.beside;  // skirting is a little above
    if (ratio > 1.1 && ratio < 2) f.below += line.beside;
    if (ratio > 0.2 && ratio < 0.85) f.border = std::max(f.border, line.within);
  }
  f.floor_beside = std::min(f.floor_beside, 2.0);
  f.below = std::min(f.below, 2.0);
  f.border = std::min(f.border, 1.0);
  f.wall = std::log1p(e.wall_px / 100);
  f.box = e.box_corners;
}

Features FeaturesOf(const DoorOutline& outline, const OutlineEvidence& e, double camera_m, double height_m) {
  const double above_m = height_m - camera_m, drop = camera_m / above_m;
  Features f;
  f.lintel = e.edges.lintel.share;
  f.lintel_ends = EndOdds(e.edges.lintel.first_px, 0.85) + EndOdds(e.edges.lintel.last_px, 0.85);
  f.frame_lintel = std::min(e.edges.frame_lintel, 0.5);
  f.whole_lintel = std::max(e.edges.frame_lintel - 0.5, 0.0);
  f.frame_upright = std::max(e.edges.frame_uprights[0], e.edges.frame_uprights[1]);
  f.width = std::pow((above_m * outline.width() - 0.95) / 0.2, 2);
  f.height = std::pow((height_m - 2.08) / 0.07, 2);
  AddFeet(outline, e, above_m, drop, f);
  AddWall(e, drop, f);
  return f;
}

/// By logistic regression on outlines of rendered corridors (part `oneimage` of the bench, seeds 1000 to
/// 1049).
constexpr double kBias = -5.41;
constexpr Features kWeights{.lintel = -0.114,
                            .lintel_ends = 0.422,
                            .uprights = 0.995,
                            .upright_ends = 0.123,
                            .weaker = -0.0576,
                            .hangs = -0.541,
                            .deep = -1.63,
                            .standing = 0.893,
                            .out_of_sight = 0.507,
                            .sill = -1.37,
                            .border = -1.78,
                            .frame_lintel = 2.05,
                            .whole_lintel = -0.726,
                            .frame_upright = 2.51,
                            .width = -0.462,
                            .height = -0.0686,
                            .floor_beside = 0.773,
                            .below = -0.414,
                            .wall = 0.0963,
                            .box = -1.16};

}  // namespace

OutlineWeigher::OutlineWeigher(const CameraView& level_view)
    : view_(level_view),
      usual_camera_(*level_view.camera),
      usual_view_(level_view),
      rays_(level_view.camera->image_from_base.leftCols<3>().inverse()) {
  usual_camera_.image_from_base.col(3) -= kUsualCamera_m * usual_camera_.image_from_base.col(2);
  usual_view_.camera = &usual_camera_;
}

OutlineEvidence OutlineWeigher::Weigh(const DoorOutline& outline) const {
  OutlineEvidence e;
  constexpr double kAbove_m = kUsualLintel_m - kUsualCamera_m;
  e.edges = WeighDoor(usual_view_, {kAbove_m * outline.At(0), kAbove_m * outline.At(1), kUsualLintel_m});
  for (const ViewLine& line : view_.lines)
    if (IsLevel(line))
      if (const auto on_wall = OnWall(outline, line, rays_)) e.wall_lines.push_back(*on_wall);
  e.box_corners = IsBoxCorner(view_, outline, 0) + IsBoxCorner(view_, outline, 1);
  e.wall_px = AlongWalls(view_, outline);
  return e;
}

double OutlineLogOdds(const DoorOutline& outline, const OutlineEvidence& evidence, double camera_m,
                      double height_m) {
  const Features f = FeaturesOf(outline, evidence, camera_m, height_m);
  constexpr double Features::*kAll[] = {
      &Features::lintel,       &Features::lintel_ends,   &Features::uprights, &Features::upright_ends,
      &Features::weaker,       &Features::hangs,         &Features::deep,     &Features::standing,
      &Features::out_of_sight, &Features::sill,          &Features::border,   &Features::frame_lintel,
      &Features::whole_lintel, &Features::frame_upright, &Features::width,    &Features::height,
      &Features::floor_beside, &Features::below,         &Features::wall,     &Features::box};
  double sum = kBias;
  for (const auto feature : kAll) sum += kWeights.*feature * f.*feature;
  return sum;
}

}  // namespace priamos::head
