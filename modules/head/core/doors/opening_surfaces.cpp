#include "head/core/doors/opening_surfaces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr int kHalfWidth_px = 6, kHalfHeight_px = 12, kRowStep_px = 2;
constexpr int kColumns = 2 * kHalfWidth_px + 1, kRows = kHalfHeight_px / kRowStep_px * 2 + 1;
constexpr int kBetween_px = 8, kBetweenRows_px = 32;  ///< windows
constexpr double kPeak_px = 4;                        ///< nearer depths belong to the same peak
constexpr double kPeakError = 0.08;                   ///< of the top of a peak, share of two steps

/// Grey values of one window, mean 0.
struct Window {
  std::array<float, static_cast<std::size_t>(kColumns) * kRows> grey;
  double deviation = 0;
};

std::optional<float> GreyAt(const GreyImage& image, const Vector2d& at) {
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < image.width - 1 && at.y() < image.height - 1))
    return std::nullopt;
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  const auto s = static_cast<float>(at.x() - u), t = static_cast<float>(at.y() - v);
  const std::uint8_t* p = image.pixels.data() + static_cast<std::ptrdiff_t>(v) * image.width + u;
  const auto row = [&](const std::uint8_t* q) {
    return static_cast<float>(q[0]) + s * static_cast<float>(q[1] - q[0]);
  };
  const float upper = row(p);
  return upper + t * (row(p + image.width) - upper);
}

/// The picture where `to_image` takes the pixels of a window about `middle`; nullopt: not all of it is there.
template <class ToImage>
std::optional<Window> Cut(const GreyImage& image, const Vector2d& middle, ToImage to_image) {
  Window window;
  std::size_t n = 0;
  float sum = 0;
  for (int row = -kHalfHeight_px; row <= kHalfHeight_px; row += kRowStep_px) {
    for (int column = -kHalfWidth_px; column <= kHalfWidth_px; ++column) {
      const auto grey = GreyAt(image, to_image(Vector2d(middle + Vector2d(column, row))));
      if (!grey) return std::nullopt;
      sum += window.grey[n++] = *grey;
    }
  }
  const float mean = sum / static_cast<float>(n);
  float squares = 0;
  for (float& grey : window.grey) {
    grey -= mean;
    squares += grey * grey;
  }
  window.deviation = std::sqrt(squares / static_cast<float>(n));
  return window;
}

double Correlation(const Window& a, const Window& b) {
  float sum = 0;
  for (std::size_t i = 0; i < a.grey.size(); ++i) sum += a.grey[i] * b.grey[i];
  return sum / (static_cast<double>(a.grey.size()) * std::max(1e-3, a.deviation * b.deviation));
}

class Sweep {
 public:
  Sweep(const OpeningShape& opening, const StereoPictures& pictures, const SurfaceOptions& options)
      : opening_(opening), pictures_(pictures), options_(options) {
    const CameraModel &left = *pictures.cameras[0], &right = *pictures.cameras[1];
    ray_from_image_ = left.image_from_base.leftCols<3>().inverse();
    eye_ = OpticalCentre(left);
    const Vector2d through = opening.base_from_door.rotation().col(0);
    normal_ = {through.x(), through.y(), 0};
    eye_x_ = (opening.base_from_door.Inverse() * Vector2d(eye_.head<2>())).x();
    epipole_ = right.image_from_base * eye_.homogeneous();
    ChooseDepths();
  }

  std::vector<SurfacePoint> Run() const {
    std::vector<SurfacePoint> points;
    if (depths_.size() < 3) return points;
    const auto [low, high] = Bounds();
    for (double v = low.y(); v <= high.y(); v += kBetweenRows_px)
      for (double u = low.x(); u <= high.x(); u += kBetween_px)
        if (const auto point = At({u, v})) points.push_back(*point);
    return points;
  }

 private:
  struct Depth {
    double x_m, disparity_px;
    Eigen::Matrix3d right_from_left;
  };

  Vector3d InBase(double x, double y, double z) const {
    const Vector2d p = opening_.base_from_door * Vector2d(x, y);
    return {p.x(), p.y(), z};
  }

  /// Image of the left one's pixels in the right one, by the plane so far behind the door.
  Eigen::Matrix3d RightFromLeft(double x_m) const {
    const double away_m = x_m - eye_x_;
    return (epipole_ * normal_.transpose() + away_m * pictures_.cameras[1]->image_from_base.leftCols<3>()) *
           ray_from_image_;
  }

  static Vector2d Apply(const Eigen::Matrix3d& h, const Vector2d& p) {
    return (h * p.homogeneous()).hnormalized();
  }

  void ChooseDepths() {
    if (eye_x_ > -options_.before_m - 0.2) return;  // too near to tell anything
    const Vector2d middle = pictures_.cameras[0]->Project(InBase(0, 0, opening_.height_m / 2));
    const Vector2d far = Apply(RightFromLeft(1e4), middle);
    double last_px = 1e9;
    for (double x = -options_.before_m; x < options_.behind_m; x += 0.005) {
      const Eigen::Matrix3d h = RightFromLeft(x);
      const double disparity_px = (Apply(h, middle) - far).norm();
      if (last_px - disparity_px < options_.step_px) continue;
      last_px = disparity_px;
      depths_.push_back({x, disparity_px, h});
    }
  }

  /// Left picture, around the opening.
  std::pair<Vector2d, Vector2d> Bounds() const {
    Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    const double half = opening_.width_m / 2 - options_.margin_m;
    for (const double y : {-half, half}) {
      for (const double z : {options_.low_m, opening_.height_m - 2 * options_.margin_m}) {
        const Vector2d p = pictures_.cameras[0]->Project(InBase(0, y, z));
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    const GreyImage& image = *pictures_.images[0];
    return {low.cwiseMax(Vector2d(kHalfWidth_px, kHalfHeight_px)),
            high.cwiseMin(Vector2d(image.width - kHalfWidth_px, image.height - kHalfHeight_px))};
  }

  /// Where a sight meets the plane so far behind the door, door frame.
  Vector3d On(const Vector2d& image_px, double x_m) const {
    const Vector3d ray = ray_from_image_ * image_px.homogeneous();
    const Vector3d at = eye_ + ray * ((x_m - eye_x_) / normal_.dot(ray));
    const Vector2d in_door = opening_.base_from_door.Inverse() * Vector2d(at.head<2>());
    return {in_door.x(), in_door.y(), at.z()};
  }

  bool IsThrough(const Vector2d& image_px) const {
    for (const double x : {0.0, options_.reveal_m}) {
      for (const double side : {-1.0, 1.0}) {
        const Vector3d at = On(image_px + Vector2d(side * kHalfWidth_px, 0), x);
        if (std::abs(at.y()) > opening_.width_m / 2 - options_.margin_m || at.z() < options_.low_m ||
            at.z() > opening_.height_m - 2 * options_.margin_m)
          return false;
      }
    }
    return true;
  }

  std::optional<SurfacePoint> At(const Vector2d& middle) const {
    if (!IsThrough(middle)) return std::nullopt;
    const CameraModel &left = *pictures_.cameras[0], &right = *pictures_.cameras[1];
    const auto window = Cut(*pictures_.images[0], middle, [&](const Vector2d& p) { return left.Distort(p); });
    if (!window || window->deviation < options_.min_grey) return std::nullopt;
    std::vector<double> likeness(depths_.size(), -1);
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      const auto other = Cut(*pictures_.images[1], middle, [&](const Vector2d& p) {
        return right.Distort(Apply(depths_[i].right_from_left, p));
      });
      if (other && other->deviation > options_.min_grey / 2) likeness[i] = Correlation(*window, *other);
    }
    return Peak(middle, likeness);
  }

  std::optional<SurfacePoint> Peak(const Vector2d& middle, const std::vector<double>& likeness) const {
    const auto best =
        static_cast<std::size_t>(std::max_element(likeness.begin(), likeness.end()) - likeness.begin());
    if (best == 0 || best + 1 == likeness.size() || likeness[best] < options_.min_similarity)
      return std::nullopt;
    for (std::size_t i = 0; i < likeness.size(); ++i) {
      const bool same = std::abs(depths_[i].disparity_px - depths_[best].disparity_px) < kPeak_px;
      if (!same && likeness[i] > likeness[best] - options_.min_lead) return std::nullopt;
    }
    // The top of a parabola through three values.
    const double a = likeness[best - 1], b = likeness[best], c = likeness[best + 1];
    const double shift = std::clamp(0.5 * (a - c) / std::min(-1e-6, a - 2 * b + c), -0.5, 0.5);
    const double x_m = depths_[best].x_m + (shift > 0 ? shift * (depths_[best + 1].x_m - depths_[best].x_m)
                                                      : shift * (depths_[best].x_m - depths_[best - 1].x_m));
    const Vector3d at = On(middle, x_m);
    return SurfacePoint{at.head<2>(), kPeakError * (depths_[best + 1].x_m - depths_[best - 1].x_m)};
  }

  OpeningShape opening_;
  const StereoPictures& pictures_;
  const SurfaceOptions& options_;
  Eigen::Matrix3d ray_from_image_;
  Vector3d eye_, normal_, epipole_;
  double eye_x_;
  std::vector<Depth> depths_;
};

}  // namespace

std::vector<SurfacePoint> SurfacesIn(const OpeningShape& opening, const StereoPictures& pictures,
                                     const SurfaceOptions& options) {
  return Sweep(opening, pictures, options).Run();
}

}  // namespace priamos::head
