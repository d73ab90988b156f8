#include "head/core/calibration/discs/disc_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "head/core/calibration/discs/disc_model.hpp"
#include "head/core/calibration/discs/disc_window.hpp"

namespace priamos::head {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kFitSteps = 5;
constexpr double kConverged_px = 1.5e-3;
constexpr double kMarginSlack_px = 1;  // for the fit to move within

bool Sane(const DiscModel& m, const DetectedDisc& start) {
  const double ratio = m.k.determinant() * start.ellipse.shape_px2.determinant();
  return m.k(0, 0) > 0 && ratio > 0.2 && ratio < 5 && m.amplitude > 1 &&
         (m.centre - start.ellipse.centre_px).norm() < 0.3 * start.ellipse.SemiMajor() + 0.5;
}

DetectedDisc Result(const DiscModel& m, const NormalEquations& eq) {
  DetectedDisc disc;
  disc.ellipse = {m.centre, m.k.inverse()};
  disc.background = m.background;
  disc.amplitude = m.amplitude;
  disc.blur_sigma_px = std::sqrt(std::max(0.0, m.rim_sigma * m.rim_sigma - kPixelVariance));
  const double variance = eq.squares / std::max(1, eq.pixels - 12);
  disc.residual = std::sqrt(variance);
  const Matrix6d inverse = eq.odd.ldlt().solve(Matrix6d::Identity());
  disc.sigma_px = std::sqrt(variance * (inverse(0, 0) + inverse(1, 1)) / 2);
  return disc;
}

}  // namespace

std::optional<DetectedDisc> FitDisc(const GreyImage& image, const DetectedDisc& start,
                                    std::span<const Ellipse> others) {
  const Matrix2d blur = 4 * start.blur_sigma_px * start.blur_sigma_px * Matrix2d::Identity();
  Matrix2d shape = start.ellipse.shape_px2 - blur;
  if (shape(0, 0) < 1 || shape.determinant() < 1) shape = start.ellipse.shape_px2;
  DiscModel model{start.ellipse.centre_px, shape.inverse(),
                  std::sqrt(start.blur_sigma_px * start.blur_sigma_px + kPixelVariance), start.amplitude,
                  start.background};
  const Ellipse window = Grown(start.ellipse, kRimReach_px + 1);
  if (!BoundingBox(image, window)) return std::nullopt;
  WindowPixels pixels;
  NormalEquations eq;
  for (int i = 0; i < kFitSteps; ++i) {
    const double fade_px = RimFade(model);
    if (fade_px > pixels.margin_px) {
      pixels.Collect(image, {window.centre_px, shape}, window, others, fade_px + kMarginSlack_px);
    }
    eq = Linearise(model, pixels, window.centre_px);
    if (eq.pixels < 15) return std::nullopt;
    const Vector2d before = model.centre;
    model.Step(eq);
    if (!Sane(model, start)) return std::nullopt;
    if (i > 0 && (model.centre - before).norm() < kConverged_px) break;
  }
  return Result(model, eq);
}

}  // namespace priamos::head
