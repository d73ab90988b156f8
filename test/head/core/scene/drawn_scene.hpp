#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/geometry.hpp"
#include "head/core/scene/upright_edges.hpp"
#include "head/core/stereo/edge_stereo.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::test {

/// What a perfect operator would see of faces and boxes, in the pictures of a level head 1.2 m above the
/// floor: left, right, and of a third camera between them and 12 cm above.
class DrawnScene {
 public:
  /// An edge of space, as far as each picture shows it; each has other grey values, so that it is like no
  /// other.
  void Edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const double dark = 40 + 25 * (n_edges_ % 5), bright = dark + 40 + 10 * (n_edges_ % 3);
    ++n_edges_;
    for (ExactView* view : {&left_, &right_, &third_}) {
      const auto edge = head::ProjectEdge(view->camera(), {768, 576}, from, to);
      if (edge) view->Draw(edge->p, edge->q, dark, bright);
    }
  }
  void Upright(const Eigen::Vector2d& at, double bottom, double top) {
    Edge(Above(at, bottom), Above(at, top));
  }
  void Level(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double z) {
    Edge(Above(from, z), Above(to, z));
  }
  /// An upright rectangle with all its edges.
  void Face(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bottom, double top) {
    Upright(from, bottom, top);
    Upright(to, bottom, top);
    Level(from, to, bottom);
    Level(from, to, top);
  }
  /// A box from the floor up, of which front and left side are seen.
  void Box(const Pose2& base_from_front, double width, double depth, double height) {
    const Eigen::Vector2d left = base_from_front * Eigen::Vector2d(0, width / 2),
                          right = base_from_front * Eigen::Vector2d(0, -width / 2),
                          back = base_from_front * Eigen::Vector2d(depth, width / 2);
    Face(left, right, 0, height);
    Upright(back, 0, height);
    Level(left, back, 0);
    Level(left, back, height);
  }

  /// A level rectangle, as the top of a table.
  void Top(const Pose2& base_from_front, double width, double depth, double height) {
    const Eigen::Vector2d left = base_from_front * Eigen::Vector2d(0, width / 2),
                          right = base_from_front * Eigen::Vector2d(0, -width / 2),
                          left_behind = base_from_front * Eigen::Vector2d(depth, width / 2),
                          right_behind = base_from_front * Eigen::Vector2d(depth, -width / 2);
    Level(left, right, height);
    Level(left, left_behind, height);
    Level(right, right_behind, height);
    Level(left_behind, right_behind, height);
  }

  head::StereoViews Views() const { return {left_.View(), right_.View()}; }
  head::CameraView Third() const { return third_.View(); }
  /// Matches of all three pictures beside those of two.
  std::vector<head::StereoMatch> MatchesOfAll(const head::StereoViews& views,
                                              const head::CameraView& third) const {
    std::vector<head::StereoMatch> matches = Matches(views);
    for (const head::StereoMatch& match : head::MatchTrinocular(views[0], views[1], third, {}))
      matches.push_back(match);
    return matches;
  }
  std::vector<head::StereoMatch> Matches(const head::StereoViews& views) const {
    return head::MatchBinocular(views[0], views[1], {});
  }
  std::vector<head::UprightEdge> Uprights(const head::StereoViews& views) const {
    return head::FindUprights(Matches(views), {});
  }

 private:
  static Eigen::Vector3d Above(const Eigen::Vector2d& at, double z) { return {at.x(), at.y(), z}; }

  static head::CameraModel ThirdCamera() {
    head::CameraModel camera = HeadCamera(0, 1);
    const Eigen::Vector3d eye = head::OpticalCentre(camera);
    const Eigen::Vector3d up(0, -eye.y(), 0.12);
    camera.image_from_base.col(3) -= camera.image_from_base.leftCols<3>() * up;
    return camera;
  }

  ExactView left_{HeadCamera(0, 1)}, right_{HeadCamera(0, -1)}, third_{ThirdCamera()};
  int n_edges_ = 0;
};

}  // namespace priamos::test
