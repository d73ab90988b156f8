#include "head/core/doors/leaf_sight.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "head/core/camera/projection.hpp"
#include "head/core/doors/leaf_shape.hpp"
#include "head/core/doors/line_cover.hpp"

namespace priamos::head {
namespace {

constexpr std::array<const char*, 2> kHinges{"left", "right"};
constexpr double kLeast_px = 12;       ///< shorter edges are no evidence
constexpr double kOwn_px = 2.5;        ///< what lies so near to the outline of the opening belongs to it
constexpr double kMinHeight_m = 0.25;  ///< least visible height of an upright edge that may be a leaf's
constexpr double kClear_m = 0.12;      ///< what lies so far behind the leaf would be hidden by it

/// The door in one pair of images.
struct Scene {
  const DoorPlan& door;
  Pose2 base_from_door, door_from_base;
  const StereoViews& views;
  std::array<Eigen::Vector3d, 2> viewers;  ///< optical centres, door frame
};

/// An upright edge seen through the opening.
struct Upright {
  Eigen::Vector2d at;  ///< door frame [m]
  Eigen::Matrix2d covariance;
  double z_max_m;
};

/// A leaf as one upright edge suggests it.
struct Hypothesis {
  int hinge;
  double open_rad, sigma_rad, log_odds;
};

Eigen::Vector3d InDoor(const Pose2& door_from_base, const Eigen::Vector3d& p) {
  const Eigen::Vector2d on_floor = door_from_base * Eigen::Vector2d(p.head<2>());
  return {on_floor.x(), on_floor.y(), p.z()};
}

Eigen::Vector3d InBase(const Pose2& base_from_door, const Eigen::Vector3d& p) {
  return InDoor(base_from_door, p);
}

/// A line on the picture's side of the opening's outline.
bool IsThroughOpening(const Scene& scene, int camera, const ViewLine& line) {
  const CameraView& view = scene.views[camera];
  const double half = scene.door.opening_width_m / 2;
  const Eigen::Vector2d middle = (line.p + line.q) / 2;
  for (const double x : {scene.door.FrontX(), scene.door.StopX()}) {
    const auto image = [&](double y) {
      return view.camera->Project(
          InBase(scene.base_from_door, {x, y, std::min(1.3, scene.door.opening_height_m)}));
    };
    if (middle.x() < image(half).x() + kOwn_px || middle.x() > image(-half).x() - kOwn_px) return false;
  }
  return true;
}

/// The lines of a picture that may be seen through the opening.
CameraView Through(const Scene& scene, int camera) {
  CameraView inner;
  const CameraView& view = scene.views[camera];
  inner.camera = view.camera;
  inner.edges = view.edges;
  inner.size = view.size;
  for (const ViewLine& line : view.lines)
    if (IsThroughOpening(scene, camera, line)) inner.lines.push_back(line);
  return inner;
}

std::vector<Upright> UprightsBehind(const Scene& scene, const VerticalStereoOptions& options) {
  std::vector<Upright> uprights;
  const Eigen::Matrix2d turn = scene.door_from_base.rotation();
  for (const VerticalEdge& edge : MatchVerticals(Through(scene, 0), Through(scene, 1), options)) {
    const Eigen::Vector2d at = scene.door_from_base * edge.at;
    if (at.x() < scene.door.StopX() || edge.z_max_m - edge.z_min_m < kMinHeight_m) continue;
    uprights.push_back({at, turn * edge.covariance * turn.transpose(), edge.z_max_m});
  }
  return uprights;
}

/// The leaf whose free arris number `end` is this edge; nullopt if it is on no such circle.
std::optional<Hypothesis> LeafOn(const Scene& scene, const Upright& edge, int hinge, int end,
                                 const LeafOptions& options) {
  const DoorPlan& door = scene.door;
  const auto arris = [&](double open_rad) {
    return LeafAt(door, kHinges[hinge], open_rad, options.thickness_m).FreeEnds()[end];
  };
  // The pin is the point about which three positions of the arris turn: those at 0, 90 and 180 degrees.
  const Eigen::Vector2d pin = (arris(0) + arris(kPi)) / 2;
  const Eigen::Vector2d closed = arris(0) - pin, seen = edge.at - pin;
  const double side = hinge == 0 ? 1 : -1;
  const double open_rad =
      side * WrapAngle(std::atan2(seen.y(), seen.x()) - std::atan2(closed.y(), closed.x()));
  if (open_rad < options.least_rad || open_rad > options.most_rad) return std::nullopt;
  const Eigen::Vector2d out = seen.normalized(), across(-out.y(), out.x());
  const double pin2 = std::pow(options.pin_sigma_m, 2);
  const double off_m = seen.norm() - closed.norm();
  const double chi2 = off_m * off_m / (out.dot(edge.covariance * out) + pin2);
  if (chi2 > options.gate * options.gate) return std::nullopt;
  const double sigma_rad = std::sqrt(across.dot(edge.covariance * across) + pin2) / closed.norm();
  return Hypothesis{hinge, open_rad, sigma_rad, -chi2 / 2};
}

/// Log odds of the covered share of an edge that should be seen. A leaf may be as bright as what is behind
/// it, so a part is missing often; the whole hardly ever.
double OfShare(double share, double none, double all) {
  constexpr double kSome = 0.05, kMost = 0.6;
  return none + (all - none) * std::clamp((share - kSome) / (kMost - kSome), 0.0, 1.0);
}

/// The expected image of an edge, as far as it is seen through the opening; nullopt: too little.
std::optional<ExpectedLine> Expect(const Scene& scene, int camera, const DoorEdge& edge) {
  const auto seen = ThroughOpening(scene.door, scene.viewers[camera], edge);
  if (!seen) return std::nullopt;
  const CameraView& view = scene.views[camera];
  const auto image = ProjectEdge(*view.camera, view.size, InBase(scene.base_from_door, seen->from),
                                 InBase(scene.base_from_door, seen->to));
  if (!image || image->length_px() < kLeast_px) return std::nullopt;
  return ExpectedLine(image->p, image->q);
}

/// The best cover among edges of which one must be seen; nullopt: none can be.
std::optional<Cover> BestCover(const Scene& scene, int camera, const std::vector<DoorEdge>& edges) {
  std::optional<Cover> best;
  for (const DoorEdge& edge : edges) {
    const auto expected = Expect(scene, camera, edge);
    if (!expected) continue;
    const Cover cover = CoverOfAnyContrast(scene.views[camera], *expected);
    if (!best || cover.share > best->share) best = cover;
  }
  return best;
}

/// Evidence of one image for a leaf.
double InImage(const Scene& scene, int camera, const LeafAt& leaf) {
  const Eigen::Vector2d viewer = scene.viewers[camera].head<2>();
  double sum = 0;
  const auto free = BestCover(scene, camera, leaf.FreeEdges(viewer));
  if (!free) return -4;  // such a leaf would not be seen
  sum += OfShare(free->share, -4, 1.5);
  if (free->first_px < -8) sum -= 2;  // it goes on above the leaf
  if (const auto upper = BestCover(scene, camera, leaf.UpperEdges(viewer)))
    sum += OfShare(upper->share, -2.5, 2.5);
  return sum;
}

/// Evidence of everything seen in space against a leaf that would hide it.
double Hidden(const Scene& scene, const std::vector<Upright>& uprights, const LeafAt& leaf) {
  int hidden = 0;
  for (const Upright& edge : uprights) {
    bool both = true;
    for (const Eigen::Vector3d& viewer : scene.viewers)
      both = both && leaf.Hides(viewer.head<2>(), edge.at, kClear_m);
    hidden += both;
  }
  return -1.0 * std::min(hidden, 4);
}

LeafSight Decide(const std::vector<Hypothesis>& all, const LeafOptions& options) {
  LeafSight sight;
  if (all.empty()) return sight;
  const Hypothesis& best = *std::max_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.log_odds < b.log_odds; });
  double rival = -1e9, weight = 0, sum = 0;
  for (const Hypothesis& h : all) {
    const bool same = h.hinge == best.hinge && std::abs(h.open_rad - best.open_rad) < options.distinct_rad;
    if (!same) rival = std::max(rival, h.log_odds);
    if (!same || h.log_odds < best.log_odds - 2) continue;
    weight += 1 / (h.sigma_rad * h.sigma_rad);
    sum += h.open_rad / (h.sigma_rad * h.sigma_rad);
  }
  sight.log_odds = best.log_odds;
  if (best.log_odds < options.min_log_odds || rival > best.log_odds - options.min_lead) return sight;
  sight.hinge = best.hinge == 0 ? LeafSight::Hinge::kLeft : LeafSight::Hinge::kRight;
  sight.open_rad = sum / weight;
  sight.sigma_rad = best.sigma_rad;
  return sight;
}

}  // namespace

LeafSight SeeLeaf(const DoorPlan& door, const Pose2& base_from_door, const StereoViews& views,
                  const LeafOptions& options) {
  Scene scene{door, base_from_door, base_from_door.Inverse(), views, {}};
  for (int i = 0; i < 2; ++i)
    scene.viewers[i] = InDoor(scene.door_from_base, OpticalCentre(*views[i].camera));
  const std::vector<Upright> uprights = UprightsBehind(scene, options.stereo);
  std::vector<Hypothesis> all;
  for (const Upright& edge : uprights) {
    for (int hinge = 0; hinge < 2; ++hinge) {
      for (int end = 0; end < 2; ++end) {
        auto h = LeafOn(scene, edge, hinge, end, options);
        if (!h) continue;
        const LeafAt leaf(door, kHinges[hinge], h->open_rad, options.thickness_m);
        h->log_odds += InImage(scene, 0, leaf) + InImage(scene, 1, leaf) + Hidden(scene, uprights, leaf);
        all.push_back(*h);
      }
    }
  }
  return Decide(all, options);
}

}  // namespace priamos::head
