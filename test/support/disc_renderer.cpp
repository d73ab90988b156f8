#include "test/support/disc_renderer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace priamos::support {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Quad = Eigen::Matrix<double, 2, 4>;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Signed area of the unit disc's sector between the directions of a and b.
double SectorArea(const Vector2d& a, const Vector2d& b) {
  return std::atan2(Cross(a, b), a.dot(b)) / 2;
}

/// Signed area of the unit disc within the triangle (origin, a, b).
double TriangleInDisc(const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double aa = d.squaredNorm(), half_b = a.dot(d), c = a.squaredNorm() - 1;
  const double discriminant = half_b * half_b - aa * c;
  if (discriminant <= 0 || aa == 0) return SectorArea(a, b);
  const double root = std::sqrt(discriminant);
  const double enter = (-half_b - root) / aa, leave = (-half_b + root) / aa;
  if (leave <= 0 || enter >= 1) return SectorArea(a, b);
  const Vector2d from = enter > 0 ? Vector2d(a + enter * d) : a;
  const Vector2d to = leave < 1 ? Vector2d(a + leave * d) : b;
  double area = Cross(from, to) / 2;
  if (enter > 0) area += SectorArea(a, from);
  if (leave < 1) area += SectorArea(to, b);
  return area;
}

/// The corners of a square around the origin.
Quad Square(double half) {
  Quad q;
  q << -half, half, half, -half, -half, -half, half, half;
  return q;
}

double QuadArea(const Quad& corners) {
  return Cross(corners.col(2) - corners.col(0), corners.col(3) - corners.col(1)) / 2;
}

std::vector<double> GaussianKernel(double sigma) {
  const int reach = std::max(0, static_cast<int>(std::ceil(4 * sigma)));
  std::vector<double> kernel(2 * reach + 1, 1.0);
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    if (sigma > 0) kernel[i + reach] = std::exp(-i * i / (2 * sigma * sigma));
    sum += kernel[i + reach];
  }
  for (double& k : kernel) k /= sum;
  return kernel;
}

/// Convolves along one axis (`step` apart, `length` long) of `lines` lines that are `line_step` apart.
void Convolve(std::vector<float>& light, int lines, int line_step, int length, int step,
              const std::vector<double>& kernel) {
  const int reach = static_cast<int>(kernel.size() / 2);
  std::vector<float> line(length);
  for (int l = 0; l < lines; ++l) {
    float* data = light.data() + static_cast<std::size_t>(l) * line_step;
    for (int i = 0; i < length; ++i) line[i] = data[static_cast<std::size_t>(i) * step];
    for (int i = 0; i < length; ++i) {
      double sum = 0;
      for (int k = -reach; k <= reach; ++k) sum += kernel[k + reach] * line[std::clamp(i + k, 0, length - 1)];
      data[static_cast<std::size_t>(i) * step] = static_cast<float>(sum);
    }
  }
}

}  // namespace

double CoveredShare(const head::Ellipse& ellipse, const Quad& corners) {
  const Matrix2d circle_from_px = Matrix2d(ellipse.shape_px2.llt().matrixL()).inverse();
  const Quad q = circle_from_px * (corners.colwise() - ellipse.centre_px);
  double area = 0;
  for (int i = 0; i < 4; ++i) area += TriangleInDisc(q.col(i), q.col((i + 1) % 4));
  return std::clamp(area / QuadArea(q), 0.0, 1.0);
}

DiscRenderer::DiscRenderer(int width, int height, double background, int subpixels)
    : width_(width),
      height_(height),
      subpixels_(subpixels),
      light_(static_cast<std::size_t>(width) * height * subpixels * subpixels,
             static_cast<float>(background)) {}

/// Calls change(light of the subpixel, its centre) for every subpixel of the box.
template <class Change>
void DiscRenderer::Fill(const Vector2d& low_px, const Vector2d& high_px, const Change& change) {
  const int w = width_ * subpixels_, h = height_ * subpixels_;
  const auto index = [&](double px) { return static_cast<int>(std::floor((px + 0.5) * subpixels_)); };
  const int x0 = std::max(0, index(low_px.x())), x1 = std::min(w - 1, index(high_px.x()));
  const int y0 = std::max(0, index(low_px.y())), y1 = std::min(h - 1, index(high_px.y()));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      change(light_[static_cast<std::size_t>(y) * w + x], Vector2d(Centre(x), Centre(y)));
    }
  }
}

void DiscRenderer::AddEllipse(const head::Ellipse& ellipse, double amplitude) {
  const double reach = ellipse.SemiMajor() + 1;
  const double half = 0.5 / subpixels_;
  Fill(ellipse.centre_px.array() - reach, ellipse.centre_px.array() + reach,
       [&](float& light, const auto& px) {
         light += static_cast<float>(amplitude * CoveredShare(ellipse, Square(half).colwise() + px));
       });
}

bool DiscRenderer::AddDisc(const head::CameraModel& camera, const ReferenceDisc& disc, double amplitude) {
  const std::optional<head::Ellipse> ellipse = head::ProjectDisc(camera.image_from_base, disc);
  if (!ellipse) return false;
  const double half = 0.5 / subpixels_, reach = 1.3 * ellipse->SemiMajor() + 2;
  const Vector2d middle = camera.Distort(ellipse->centre_px);
  const Matrix2d inverse = ellipse->shape_px2.inverse();
  const double pixel = 1.5 / subpixels_ / ellipse->SemiMinor();
  Fill(middle.array() - reach, middle.array() + reach, [&](float& light, const Vector2d& px) {
    const Vector2d d = camera.Undistort(px) - ellipse->centre_px;
    const double radius = std::sqrt(d.dot(inverse * d));
    if (radius > 1 + pixel) return;
    double share = 1;
    if (radius > 1 - pixel) {
      Quad q = Square(half);
      for (int i = 0; i < 4; ++i) q.col(i) = camera.Undistort(px + q.col(i));
      share = CoveredShare(*ellipse, q);
    }
    light += static_cast<float>(amplitude * share);
  });
  return true;
}

double DiscRenderer::RectangleShare(const Vector2d& px, const Vector2d& low, const Vector2d& high) const {
  const double half = 0.5 / subpixels_;
  const auto overlap = [&](int axis) {
    const double from = std::max(px[axis] - half, low[axis]), to = std::min(px[axis] + half, high[axis]);
    return std::max(0.0, (to - from) / (2 * half));
  };
  return overlap(0) * overlap(1);
}

void DiscRenderer::AddRectangle(double u0, double v0, double u1, double v1, double amplitude) {
  const Vector2d low(u0, v0), high(u1, v1);
  Fill(low, high, [&](float& light, const Vector2d& px) {
    light += static_cast<float>(amplitude * RectangleShare(px, low, high));
  });
}

void DiscRenderer::Cover(double u0, double v0, double u1, double v1, double level) {
  const Vector2d low(u0, v0), high(u1, v1);
  Fill(low, high, [&](float& light, const Vector2d& px) {
    light += static_cast<float>((level - light) * RectangleShare(px, low, high));
  });
}

void DiscRenderer::AddSlope(const Vector2d& per_px) {
  const Vector2d middle((width_ - 1) / 2.0, (height_ - 1) / 2.0);
  Fill({-0.5, -0.5}, {width_ - 0.5, height_ - 0.5},
       [&](float& light, const Vector2d& px) { light += static_cast<float>(per_px.dot(px - middle)); });
}

GreyImage DiscRenderer::Expose(const Exposure& exposure, Rng& rng) const {
  std::vector<float> light = light_;
  const int w = width_ * subpixels_, h = height_ * subpixels_;
  if (exposure.blur_sigma_px > 0) {
    const std::vector<double> kernel = GaussianKernel(exposure.blur_sigma_px * subpixels_);
    Convolve(light, h, w, w, 1, kernel);
    Convolve(light, w, 1, h, w, kernel);
  }
  GreyImage image{width_, height_, std::vector<std::uint8_t>(static_cast<std::size_t>(width_) * height_)};
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      double sum = 0;
      for (int y = v * subpixels_; y < (v + 1) * subpixels_; ++y) {
        for (int x = u * subpixels_; x < (u + 1) * subpixels_; ++x) {
          sum += light[static_cast<std::size_t>(y) * w + x];
        }
      }
      const double grey = sum / (subpixels_ * subpixels_) + rng.Normal(exposure.noise_sigma);
      image.pixels[static_cast<std::size_t>(v) * width_ + u] =
          static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return image;
}

}  // namespace priamos::support
