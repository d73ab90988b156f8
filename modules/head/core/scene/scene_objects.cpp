#include "head/core/scene/scene_objects.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

class Grouping {
 public:
  Grouping(const StereoViews& views, const std::vector<UprightEdge>& uprights,
           const std::vector<UprightFace>& faces, const SceneOptions& options)
      : views_(views),
        uprights_(uprights),
        faces_(faces),
        eye_(OpticalCentre(*views[0].camera).head<2>()),
        options_(options),
        used_(faces.size()) {}

  std::vector<SceneObject> Run() {
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!used_[i] && !used_[j] && AreBox(faces_[i], faces_[j])) AddBox(i, j);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!used_[i]) objects_.push_back(WithDepth(AsObject(faces_[i])));
    for (std::size_t i = 0; i < uprights_.size(); ++i)
      if (!IsOfFace(static_cast<int>(i))) AddEdge(uprights_[i]);
    return std::move(objects_);
  }

 private:
  Eigen::Vector2d From(const UprightFace& face) const { return uprights_[face.left].at; }
  Eigen::Vector2d To(const UprightFace& face) const { return uprights_[face.right].at; }

  /// Standard deviation of the direction of a face.
  double SigmaYaw(const UprightFace& face) const {
    const Eigen::Vector2d along = (To(face) - From(face)) / face.width_m, across(-along.y(), along.x());
    const Eigen::Matrix2d both = uprights_[face.left].covariance + uprights_[face.right].covariance;
    return std::sqrt(across.dot(both * across)) / face.width_m;
  }

  /// Where two faces meet.
  struct Corner {
    Eigen::Vector2d at, to_a, to_b;  ///< place, and the ways from there to the other ends
  };
  std::optional<Corner> Meet(const UprightFace& a, const UprightFace& b) const {
    for (const bool right_of_a : {true, false}) {
      const Eigen::Vector2d at_a = right_of_a ? To(a) : From(a), at_b = right_of_a ? From(b) : To(b);
      if ((at_a - at_b).norm() > options_.corner_m) continue;
      return Corner{(at_a + at_b) / 2, (right_of_a ? From(a) : To(a)) - at_a,
                    (right_of_a ? To(b) : From(b)) - at_b};
    }
    return std::nullopt;
  }

  /// Square to each other, equally high, and with the corner towards the head: a recess has it behind.
  bool AreBox(const UprightFace& a, const UprightFace& b) const {
    const auto corner = Meet(a, b);
    if (!corner || std::abs(a.top_m - b.top_m) > options_.same_top_m) return false;
    const Eigen::Vector2d along_a = corner->to_a.normalized(), along_b = corner->to_b.normalized();
    if ((along_a + along_b).dot(corner->at - eye_) <= 0) return false;
    const double off = std::abs(std::asin(std::clamp(along_a.dot(along_b), -1.0, 1.0)));
    return off < options_.square_rad + 3 * std::hypot(SigmaYaw(a), SigmaYaw(b));
  }

  SceneObject AsObject(const UprightFace& face) const {
    SceneObject object;
    const Eigen::Vector2d along = (To(face) - From(face)) / face.width_m,
                          middle = (From(face) + To(face)) / 2;
    Eigen::Vector2d away(-along.y(), along.x());
    if (away.dot(middle - eye_) < 0) away = -away;
    object.base_from_front = {middle.x(), middle.y(), std::atan2(away.y(), away.x())};
    // The calibration's error is common to both edges: their mean is no better than one of them.
    object.covariance = (uprights_[face.left].covariance + uprights_[face.right].covariance) / 2 +
                        FrameError() +
                        options_.arris_sigma_m * options_.arris_sigma_m * along * along.transpose();
    object.sigma_yaw_rad = SigmaYaw(face);
    object.width_m = face.width_m;
    object.bottom_m = face.bottom_m;
    object.top_m = face.top_m;
    return object;
  }

  Eigen::Matrix2d FrameError() const {
    return options_.frame_sigma_m * options_.frame_sigma_m * Eigen::Matrix2d::Identity();
  }

  /// A front whose top is seen from above is that of a box.
  SceneObject WithDepth(SceneObject object) const {
    const auto depth =
        DepthBehind(views_, object.base_from_front, object.width_m, object.top_m, options_.depth);
    if (!depth) return object;
    object.kind = ObjectKind::kBox;
    object.depth_m = *depth;
    return object;
  }

  /// How squarely the head sees a face, 0 to 1.
  double Squareness(const UprightFace& face) const {
    const SceneObject object = AsObject(face);
    const Eigen::Vector2d sight = (object.base_from_front.translation() - eye_).normalized();
    return sight.dot(object.base_from_front.rotation().col(0));
  }

  void AddBox(std::size_t i, std::size_t j) {
    const bool first = Squareness(faces_[i]) > Squareness(faces_[j]);
    const UprightFace &front = faces_[first ? i : j], &side = faces_[first ? j : i];
    SceneObject box = AsObject(front);
    box.kind = ObjectKind::kBox;
    box.depth_m = side.width_m;
    box.bottom_m = std::min(front.bottom_m, side.bottom_m);
    used_[i] = used_[j] = true;
    objects_.push_back(box);
  }

  bool IsOfFace(int upright) const {
    return std::any_of(faces_.begin(), faces_.end(), [&](const UprightFace& face) {
      if (face.left == upright || face.right == upright) return true;
      return DistanceToSegment(From(face), To(face), uprights_[upright].at) < options_.faces.plane_m;
    });
  }

  void AddEdge(const UprightEdge& upright) {
    if (upright.top_m - upright.bottom_m < options_.min_edge_m) return;
    SceneObject edge;
    edge.kind = ObjectKind::kEdge;
    const Eigen::Vector2d away = upright.at - eye_;
    edge.base_from_front = {upright.at.x(), upright.at.y(), std::atan2(away.y(), away.x())};
    edge.covariance = upright.covariance + FrameError();
    edge.bottom_m = upright.bottom_m < options_.faces.on_floor_m ? 0 : upright.bottom_m;
    edge.top_m = upright.top_m;
    objects_.push_back(edge);
  }

  const StereoViews& views_;
  const std::vector<UprightEdge>& uprights_;
  const std::vector<UprightFace>& faces_;
  Eigen::Vector2d eye_;
  const SceneOptions& options_;
  std::vector<bool> used_;
  std::vector<SceneObject> objects_;
};

}  // namespace

Scene ReconstructScene(const StereoViews& views, std::span<const StereoMatch> matches,
                       const SceneOptions& options, const CameraView* third) {
  Scene scene{*views[0].camera, {}, SceneEdges(views[0], matches), {}};
  for (const ViewLine& line : views[0].lines) scene.lines.push_back({line.p, line.q});
  std::vector<UprightEdge> uprights = FindUprights(matches, options.uprights);
  AddUprightsAtLevelEnds(views, options.uprights, options.level_ends, uprights);
  const std::vector<UprightFace> faces = FindFaces(views, scene.edges, uprights, options.faces);
  scene.objects = Grouping(views, uprights, faces, options).Run();
  if (third == nullptr) return scene;
  const std::vector<LevelBorder> borders = FindLevelBorders(views, *third, matches, options.borders);
  std::ranges::move(GroupBorders(borders, scene.objects, OpticalCentre(scene.left), options.tops),
                    std::back_inserter(scene.objects));
  return scene;
}

}  // namespace priamos::head
