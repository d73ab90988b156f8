#include "test/support/space_scene.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/camera/projection.hpp"
#include "head/core/stereo/space_edge.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Few grey values, as walls and frames have: grey alone does not tell edges apart.
constexpr std::array<double, 4> kGreys{70, 110, 150, 190};

void AddSegment(head::EdgeImage& image, const Vector2d& a, const Vector2d& b, const SpaceScene::Edge& edge,
                double noise_px, Rng& rng) {
  const double length = (b - a).norm();
  if (length < 14) return;
  const Vector2d d = (b - a) / length, n(-d.y(), d.x());
  head::EdgeSegment s;
  s.sigma_normal_px = noise_px * std::sqrt(20 / length);
  s.sigma_angle_rad = s.sigma_normal_px * std::sqrt(12.0) / length;
  const double offset = rng.Normal(s.sigma_normal_px), turn = rng.Normal(s.sigma_angle_rad);
  s.centre = (a + b) / 2 + offset * n;
  const double before = length / 2 + rng.Normal(1), after = length / 2 + rng.Normal(1);
  const Vector2d along = (d + turn * n).normalized();
  s.begin = s.centre - before * along;
  s.end = s.centre + after * along;
  s.grey_left = edge.dark + rng.Normal(3);
  s.grey_right = edge.bright + rng.Normal(3);
  image.segments.push_back(s);
}

SpaceScene::Edge RandomEdge(bool only_horizontal, Rng& rng) {
  SpaceScene::Edge edge;
  const Vector3d at(rng.Uniform(2, 7), rng.Uniform(-1.6, 1.6), rng.Uniform(0.2, 2.4));
  const double length = rng.Uniform(0.2, 1.2), kind = rng.Uniform(0, 1);
  Vector3d direction(0, 0, length);
  if (only_horizontal) {
    direction = {0, length, 0};
  } else if (kind < 0.3) {
    direction = {0, length, 0};
  } else if (kind < 0.45) {
    direction = {length, 0, 0};
  } else if (kind < 0.6) {
    direction = length * Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1)).normalized();
  }
  edge.from = at - direction / 2;
  edge.to = at + direction / 2;
  const auto dark = rng.Below(3);
  edge.dark = kGreys[dark];
  edge.bright = kGreys[dark + 1 + rng.Below(3 - dark)];
  // Segments run with their bright side on the right hand: either way round.
  if (rng.Chance(0.5)) std::swap(edge.from, edge.to);
  return edge;
}

}  // namespace

SpaceScene::SpaceScene(const Options& options, Rng& rng) {
  for (int i = 0; i < options.n_edges; ++i) edges.push_back(RandomEdge(options.only_horizontal, rng));
  cameras = {HeadCamera(0, 1), HeadCamera(0, -1), HeadCamera(0, 0)};
  const Eigen::Matrix3d m = cameras[2].image_from_base.leftCols<3>();
  cameras[2].image_from_base.col(3) = -m * Vector3d(0.25, 0, 1.32);
  for (int c = 0; c < 3; ++c) {
    head::EdgeImage& image = images[c];
    image.width = 768;
    image.height = 576;
    const auto add = [&](const Vector2d& a, const Vector2d& b, const Edge& edge, int index) {
      AddSegment(image, a, b, edge, options.noise_px, rng);
      truth[c].resize(image.segments.size(), index);
    };
    for (int i = 0; i < options.n_edges; ++i) {
      const auto seen = head::ProjectEdge(cameras[c], {768, 576}, edges[i].from, edges[i].to);
      if (!seen || rng.Chance(options.missing)) continue;
      if (rng.Chance(options.broken)) {
        const Vector2d direction = seen->q - seen->p;
        const double cut = rng.Uniform(0.3, 0.7);
        add(seen->p, seen->p + (cut - 0.05) * direction, edges[i], i);
        add(seen->p + (cut + 0.05) * direction, seen->q, edges[i], i);
      } else {
        add(seen->p, seen->q, edges[i], i);
      }
    }
    for (int i = 0; i < options.n_clutter; ++i) {
      const Vector2d a(rng.Uniform(20, 748), rng.Uniform(20, 556));
      const double angle = rng.Chance(0.5) ? kPi / 2 * (rng.Chance(0.5) ? 1 : -1) : rng.Uniform(0, 2 * kPi);
      add(a, a + rng.Uniform(15, 80) * Vector2d(std::cos(angle), std::sin(angle)), RandomEdge(false, rng),
          -1);
    }
  }
  for (int c = 0; c < 3; ++c) views.push_back(head::MakeView(cameras[c], images[c]));
}

}  // namespace priamos::test
