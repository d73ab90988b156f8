#include "head/core/calibration/discs/disc_pixels.hpp"

namespace priamos::head {

using Eigen::Matrix2d;
using Eigen::Vector2d;

void FlatPixels::AddTo(NormalEquations& eq, double amplitude) const {
  Matrix2d moments;
  moments << xx, xy, xy, yy;
  eq.odd.block<2, 2>(2, 2) += amplitude * amplitude * moments;
  eq.odd.block<2, 2>(2, 4) += amplitude * moments;
  eq.odd.block<2, 2>(4, 2) += amplitude * moments;
  eq.odd.block<2, 2>(4, 4) += moments;
  eq.odd_rhs.segment<2>(2) += amplitude * Vector2d(rx, ry);
  eq.odd_rhs.segment<2>(4) += Vector2d(rx, ry);
  if (amplitude > 0) {
    eq.even.topLeftCorner<2, 2>().array() += n;
    eq.even_rhs.head<2>().array() += r;
  } else {
    eq.even(1, 1) += n;
    eq.even_rhs(1) += r;
  }
  eq.squares += squares;
  eq.pixels += static_cast<int>(n);
}

void GreySums::AddRow(const std::uint8_t* row, int u0, int u1, double origin_u, double dy) {
  int sum = 0, weighted = 0, squares = 0;
  for (int u = u0; u <= u1; ++u) {
    sum += row[u];
    weighted += row[u] * (u - u0);
    squares += row[u] * row[u];
  }
  const double count = u1 - u0 + 1, first = u0 - origin_u, last = count - 1;
  const double sum_x = count * (first + last / 2);
  n += count;
  g += sum;
  gg += squares;
  x += Vector2d(sum_x, count * dy);
  gx += Vector2d(weighted + first * sum, sum * dy);
  const double sum_xx = count * first * first + first * last * count + last * count * (2 * last + 1) / 6;
  xx(0, 0) += sum_xx;
  xx(0, 1) += sum_x * dy;
  xx(1, 0) += sum_x * dy;
  xx(1, 1) += count * dy * dy;
}

FlatPixels GreySums::Against(double level, const Vector2d& slope, const Vector2d& shift) const {
  const Vector2d d = x + n * shift, gd = gx + g * shift;
  const Matrix2d dd = xx + shift * x.transpose() + x * shift.transpose() + n * shift * shift.transpose();
  const Vector2d rd = gd - level * d - dd * slope;
  FlatPixels flat;
  flat.n = n;
  flat.r = g - level * n - slope.dot(d);
  flat.rx = rd.x();
  flat.ry = rd.y();
  flat.xx = dd(0, 0);
  flat.xy = dd(0, 1);
  flat.yy = dd(1, 1);
  flat.squares = gg - 2 * level * g - 2 * slope.dot(gd) + level * level * n + 2 * level * slope.dot(d) +
                 slope.dot(dd * slope);
  return flat;
}

void WindowPixels::Collect(const GreyImage& image, const Ellipse& disc, const Ellipse& window,
                           std::span<const Ellipse> others, double margin) {
  const std::optional<Box> box = BoundingBox(image, window);
  margin_px = margin;
  shell.clear();
  core = {};
  if (!box) return;
  const double share = others.empty() ? std::max(0.0, 1 - margin / disc.SemiMinor()) : 0;
  const Matrix2d k = window.shape_px2.inverse();
  const double core_q2 = share * share * std::sqrt(disc.shape_px2.determinant() * k.determinant());
  for (int v = box->v0; v <= box->v1; ++v) {
    const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(v) * image.width;
    const double dy = v - window.centre_px.y();
    // Where the row crosses the core: k00 dx^2 + 2 k01 dx dy + k11 dy^2 = core_q2.
    const double half_b = k(0, 1) * dy / k(0, 0);
    const double discriminant = half_b * half_b - (k(1, 1) * dy * dy - core_q2) / k(0, 0);
    int first = 1, last = 0;
    if (discriminant > 0) {
      first = static_cast<int>(std::ceil(window.centre_px.x() - half_b - std::sqrt(discriminant)));
      last = static_cast<int>(std::floor(window.centre_px.x() - half_b + std::sqrt(discriminant)));
    }
    if (first <= last) core.AddRow(row, first, last, window.centre_px.x(), dy);
    for (int u = box->u0; u <= box->u1; ++u) {
      if (u == first && first <= last) u = last + 1;
      if (u > box->u1) break;
      const double dx = u - window.centre_px.x();
      if (k(0, 0) * dx * dx + 2 * k(0, 1) * dx * dy + k(1, 1) * dy * dy > 1) continue;
      const auto hides = [&](const Ellipse& other) { return Within(other, u, v); };
      if (std::any_of(others.begin(), others.end(), hides)) continue;
      shell.push_back({static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(row[u])});
    }
  }
}

}  // namespace priamos::head
