#include "test/bench/vision/scene/front_contrast.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/camera/projection.hpp"

namespace priamos::bench {
namespace {

constexpr double kLeastDifference = 6;  // grey values, between the means of both sides
constexpr int kPlaces = 40, kNear_px = 2, kFar_px = 5;

/// Mean grey value `kNear_px` to `kFar_px` beside a place, over three rows along the edge.
double GreyBeside(const GreyImage& image, const Eigen::Vector2d& at, const Eigen::Vector2d& along,
                  const Eigen::Vector2d& beside) {
  double sum = 0;
  int n = 0;
  for (int row = -1; row <= 1; ++row) {
    for (int px = kNear_px; px <= kFar_px; ++px) {
      const Eigen::Vector2d p = at + row * along + px * beside;
      const int u = static_cast<int>(std::lround(p.x())), v = static_cast<int>(std::lround(p.y()));
      if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
      sum += image.pixels[static_cast<std::size_t>(v) * image.width + u];
      ++n;
    }
  }
  return n > 0 ? sum / n : 0;
}

double ShareIn(const SceneLook& look, int camera, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const head::CameraModel& eye = look.exact[camera];
  const auto see = [&](const Eigen::Vector3d& at) { return eye.Distort(eye.Project(at)); };
  const Eigen::Vector2d along = (see(to) - see(from)).normalized(), beside(-along.y(), along.x());
  int seen = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector2d at = see(from + (i + 0.5) / kPlaces * (to - from));
    const GreyImage& image = look.images[camera];
    seen += std::abs(GreyBeside(image, at, along, beside) - GreyBeside(image, at, along, -beside)) >
            kLeastDifference;
  }
  return static_cast<double>(seen) / kPlaces;
}

}  // namespace

FrontContrast ContrastOf(const TrueFront& front, const SceneLook& look) {
  const auto share = [&](const Eigen::Vector2d& from, double low, const Eigen::Vector2d& to) {
    const Eigen::Vector3d a(from.x(), from.y(), low), b(to.x(), to.y(), front.top_m);
    return std::min(ShareIn(look, 0, a, b), ShareIn(look, 1, a, b));
  };
  const double half = front.top_m / 2;
  return {share(front.left, half, front.left), share(front.right, half, front.right),
          share(front.left, front.top_m, front.right)};
}

}  // namespace priamos::bench
