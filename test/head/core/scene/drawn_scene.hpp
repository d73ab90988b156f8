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

/// What a perfect operator would see of faces and boxes, in both pictures of a level head 1.2 m above the
/// floor.
class DrawnScene {
 public:
  /// An edge of space, as far as each picture shows it; each has other grey values, so that it is like no
  /// other.
  void Edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const double dark = 40 + 25 * (n_edges_ % 5), bright = dark + 40 + 10 * (n_edges_ % 3);
    ++n_edges_;
    for (ExactView* view : {&left_, &right_}) {
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

  head::StereoViews Views() const { return {left_.View(), right_.View()}; }
  std::vector<head::StereoMatch> Matches(const head::StereoViews& views) const {
    return head::MatchBinocular(views[0], views[1], {});
  }
  std::vector<head::UprightEdge> Uprights(const head::StereoViews& views) const {
    return head::FindUprights(Matches(views), {});
  }

 private:
  static Eigen::Vector3d Above(const Eigen::Vector2d& at, double z) { return {at.x(), at.y(), z}; }

  ExactView left_{HeadCamera(0, 1)}, right_{HeadCamera(0, -1)};
  int n_edges_ = 0;
};

}  // namespace priamos::test
