#include "world/core/camera/lens_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "world/core/camera/fine_grid.hpp"

namespace priamos::world {
namespace {

constexpr double kCornerRadius2 = 0.36;  // (480 px / 800 px)^2
constexpr std::size_t kMostMaps = 6;

/// Undistorted places of the pixels: of every fourth one in every fourth line by the lens, between them along
/// straight lines. With a distortion of k1 = -0.1 at 900 px these leave the lens by 5e-4 px at most.
class UndistortedPlaces {
 public:
  explicit UndistortedPlaces(const TrueCamera& camera) {
    places_.reserve(std::size_t(kColumns) * kRows);
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column)
        places_.push_back(camera.Undistort(kStep * Eigen::Vector2d(column, row)));
  }
  Eigen::Vector2d At(int u, int v) const {
    const Eigen::Vector2d* upper = &places_[v / kStep * kColumns + u / kStep];
    const Eigen::Vector2d* lower = upper + kColumns;
    const double a = u % kStep / double{kStep}, b = v % kStep / double{kStep};
    return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
  }

 private:
  static constexpr int kStep = 4;
  static constexpr int kColumns = kImageWidth_px / kStep + 1, kRows = kImageHeight_px / kStep + 1;
  std::vector<Eigen::Vector2d> places_;
};

LensMap::Pixel Between(const Eigen::Vector2d& cell, double light) {
  const double x = std::clamp(cell.x() - 0.5, 0.0, FineGrid::kWidth - 1.001);
  const double y = std::clamp(cell.y() - 0.5, 0.0, FineGrid::kHeight - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  return {j * FineGrid::kWidth + i, static_cast<float>(x - i), static_cast<float>(y - j), light};
}

}  // namespace

LensMap::LensMap(const TrueCamera& camera, double vignetting) : camera_(camera), vignetting_(vignetting) {
  const UndistortedPlaces undistorted(camera);
  const double loss = (1 / std::sqrt(1 - vignetting) - 1) / kCornerRadius2;
  pixels_.reserve(std::size_t(kImageWidth_px) * kImageHeight_px);
  for (int v = 0; v < kImageHeight_px; ++v) {
    for (int u = 0; u < kImageWidth_px; ++u) {
      const double r2 =
          (Eigen::Vector2d(u, v) - camera.centre_px).squaredNorm() / (camera.focal_px * camera.focal_px);
      const double light = 1 / ((1 + loss * r2) * (1 + loss * r2));
      pixels_.push_back(Between(FineGrid::FromImage(undistorted.At(u, v)), light));
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
