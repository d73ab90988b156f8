#include "world/core/camera/lens_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "world/core/camera/fine_grid.hpp"

namespace priamos::world {
namespace {

constexpr double kCornerRadius2 = 0.36;  // (480 px / 800 px)^2
constexpr std::size_t kMostMaps = 6;

/// Functions of the distorted radius, tabulated over its square: how far to stretch to undo the distortion,
/// and how much light is left.
class LensTable {
 public:
  LensTable(const TrueCamera& camera, double vignetting) {
    const double loss = (1 / std::sqrt(1 - vignetting) - 1) / kCornerRadius2;
    const double largest = 2 * std::max(kImageWidth_px, kImageHeight_px) / camera.focal_px;
    step_ = largest * largest / (kEntries - 2);
    for (int i = 0; i < kEntries; ++i) {
      const double r2 = i * step_, r = std::sqrt(r2);
      const Eigen::Vector2d from = camera.centre_px + Eigen::Vector2d(r * camera.focal_px, 0);
      const double undistorted = (camera.UndistortRadially(from) - camera.centre_px).norm();
      stretch_[i] = r > 0 ? undistorted / (r * camera.focal_px) : 1;
      light_[i] = 1 / ((1 + loss * r2) * (1 + loss * r2));
    }
  }
  double Stretch(double r2) const { return Interpolate(stretch_, r2); }
  double Light(double r2) const { return Interpolate(light_, r2); }

 private:
  static constexpr int kEntries = 4096;
  double Interpolate(const std::array<double, kEntries>& table, double r2) const {
    const double place = std::min(r2 / step_, kEntries - 2.0);
    const int i = static_cast<int>(place);
    return table[i] + (place - i) * (table[i + 1] - table[i]);
  }
  double step_;
  std::array<double, kEntries> stretch_, light_;
};

LensMap::Pixel Between(const Eigen::Vector2d& cell, double light) {
  const double x = std::clamp(cell.x() - 0.5, 0.0, FineGrid::kWidth - 1.001);
  const double y = std::clamp(cell.y() - 0.5, 0.0, FineGrid::kHeight - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  return {j * FineGrid::kWidth + i, static_cast<float>(x - i), static_cast<float>(y - j), light};
}

}  // namespace

LensMap::LensMap(const TrueCamera& camera, double vignetting) : camera_(camera), vignetting_(vignetting) {
  const LensTable lens(camera, vignetting);
  const bool tangential = camera.p1 != 0 || camera.p2 != 0;  // no longer a function of the radius alone
  pixels_.reserve(std::size_t(kImageWidth_px) * kImageHeight_px);
  for (int v = 0; v < kImageHeight_px; ++v) {
    for (int u = 0; u < kImageWidth_px; ++u) {
      const Eigen::Vector2d from_centre = Eigen::Vector2d(u, v) - camera.centre_px;
      const double r2 = from_centre.squaredNorm() / (camera.focal_px * camera.focal_px);
      const Eigen::Vector2d undistorted =
          tangential ? camera.Undistort({u, v}) : camera.centre_px + from_centre * lens.Stretch(r2);
      pixels_.push_back(Between(FineGrid::FromImage(undistorted), lens.Light(r2)));
    }
  }
}

bool LensMap::IsOf(const TrueCamera& camera, double vignetting) const {
  const auto lens = [](const TrueCamera& c) {
    return std::array{c.focal_px, c.centre_px.x(), c.centre_px.y(), c.k1, c.k2, c.k3, c.p1, c.p2};
  };
  return lens(camera) == lens(camera_) && vignetting == vignetting_;
}

const LensMap& LensMaps::Of(const TrueCamera& camera, double vignetting) {
  const auto known = std::find_if(newest_first_.begin(), newest_first_.end(),
                                  [&](const LensMap& map) { return map.IsOf(camera, vignetting); });
  if (known != newest_first_.end()) {
    std::rotate(newest_first_.begin(), known, known + 1);
    return newest_first_.front();
  }
  newest_first_.emplace_front(camera, vignetting);
  if (newest_first_.size() > kMostMaps) newest_first_.pop_back();
  return newest_first_.front();
}

}  // namespace priamos::world
