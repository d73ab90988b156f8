#include "head/core/edges/step_meter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry.hpp"
#include "common/square.hpp"
#include "head/core/edges/image_levels.hpp"

namespace priamos::head {
namespace {

constexpr double kReducedFrom_px = 1.8;                        ///< blur from which on an image is reduced
constexpr double kPixel_px2 = 1 / 12., kBetween_px2 = 1 / 8.;  ///< blur by pixels and by interpolation
constexpr double kLeastNoise = 0.5;               ///< grey values: rounding, and what no model tells
constexpr double kWindow = 2.2;                   ///< half width of what is compared, in widths of a step
constexpr double kFarthest = 1.5, kStride = 0.5;  ///< a step is searched so far, in such strides [widths]
constexpr double kTogether = 1e-3;                ///< keeps steps in one place from growing without limit
constexpr int kMostSamples = 32;

double Bilinear(const cv::Mat& image, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  const double u = at.x() - x, v = at.y() - y;
  const auto *upper = image.ptr(y) + x, *lower = image.ptr(y + 1) + x;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

/// A step of height 1 that was blurred to width 1, from a table: thousands are asked for a body.
double BlurredStep(double x) {
  constexpr int kPerUnit = 32, kReach = 5;
  static const auto kTable = [] {
    std::array<double, 2 * kReach * kPerUnit + 2> table;
    for (int i = 0; i < static_cast<int>(table.size()); ++i)
      table[i] = 0.5 * std::erfc(-(static_cast<double>(i) / kPerUnit - kReach) / std::sqrt(2.0));
    return table;
  }();
  const double place = std::clamp((x + kReach) * kPerUnit, 0.0, 2.0 * kReach * kPerUnit);
  const int i = static_cast<int>(place);
  return kTable[i] + (place - i) * (kTable[i + 1] - kTable[i]);
}

}  // namespace

/// Mean grey values across a piece, less their mean; the middle one lies on the line [reduced px].
struct StepMeter::Profile {
  int half = 0, n_steps = 1;
  double mean = 0, noise = 0, variance = 0;  ///< of all; of one value; sum of the squares of all
  std::array<double, kMostSamples> grey{};
  std::array<double, kMostSteps> places{};  ///< of the steps, the one to measure first
};

struct StepMeter::Fit {
  double shift = 0, misfit = 0, contrast = 0, spread = 0;  ///< misfit: sum of squares; spread: see Measure
};

StepMeter::StepMeter(const cv::Mat& image, double noise_sigma, double blur_px) : reduced_(image) {
  cv::Mat half;
  for (; blur_px / factor_ > kReducedFrom_px && Halve(reduced_, half); factor_ *= 2) {
    reduced_ = half;
    half = cv::Mat();  // not the one that reduced_ refers to
  }
  noise_ = std::max(noise_sigma, kLeastNoise) / factor_;
  sigma_ = std::sqrt(Square(blur_px / factor_) + kPixel_px2 + kBetween_px2);
}

std::optional<Step> StepMeter::Measure(const Eigen::Vector2d& at, const Eigen::Vector2d& normal,
                                       double length_px, std::span<const double> beside_px) const {
  Profile profile;
  for (const double beside : beside_px)
    if (profile.n_steps < kMostSteps) profile.places[profile.n_steps++] = beside / factor_;
  if (!Sample(at, normal, length_px, profile)) return std::nullopt;
  const Fit fit = FitBest(profile);
  const int n_free = 2 * profile.half - 1 - profile.n_steps;
  const double variance = std::max(Square(profile.noise), fit.misfit / std::max(1, n_free));
  return Step{.shift_px = factor_ * fit.shift,
              .contrast = fit.contrast,
              .contrast_sigma = std::sqrt(variance * fit.spread),
              .grey = profile.mean,
              .explained = profile.variance > 0 ? 1 - fit.misfit / profile.variance : 0,
              .steepest = Steepest(profile)};
}

bool StepMeter::Sample(const Eigen::Vector2d& at, const Eigen::Vector2d& normal, double length_px,
                       Profile& profile) const {
  const Eigen::Vector2d middle = ToLevel(at, factor_), along(normal.y(), -normal.x());
  profile.half = std::min(kMostSamples / 2 - 1, static_cast<int>(std::ceil(kWindow * sigma_ + 1.2)));
  const int n = 2 * profile.half + 1, n_rows = std::max(1, static_cast<int>(length_px / factor_));
  const double margin = profile.half + n_rows / 2.0 + 2;
  if (!(middle.x() > margin && middle.y() > margin && middle.x() < reduced_.cols - margin - 1 &&
        middle.y() < reduced_.rows - margin - 1))
    return false;
  for (int i = 0; i < n; ++i) {
    for (int row = 0; row < n_rows; ++row)
      profile.grey[i] +=
          Bilinear(reduced_, middle + (i - profile.half) * normal + (row - (n_rows - 1) / 2.0) * along);
    profile.grey[i] /= n_rows;
    profile.mean += profile.grey[i] / n;
  }
  for (int i = 0; i < n; ++i) {
    profile.grey[i] -= profile.mean;
    profile.variance += Square(profile.grey[i]);
  }
  profile.noise = noise_ / std::sqrt(static_cast<double>(n_rows));
  return true;
}

/// Least squares for the height of a lone step, moved by `shift`.
StepMeter::Fit StepMeter::FitOne(const Profile& profile, double shift) const {
  double sum = 0, squares = 0, products = 0;
  const int n = 2 * profile.half + 1;
  for (int i = 0; i < n; ++i) {
    const double step = BlurredStep((i - profile.half - shift) / sigma_);
    sum += step;
    squares += step * step;
    products += step * profile.grey[i];
  }
  const double own = squares - sum * sum / n + kTogether;
  return {shift, std::max(0.0, profile.variance - products * products / own), products / own, 1 / own};
}

/// Least squares for the heights of all steps, moved by `shift` as a whole.
StepMeter::Fit StepMeter::FitAt(const Profile& profile, double shift) const {
  if (profile.n_steps == 1) return FitOne(profile, shift);
  using Heights = Eigen::Matrix<double, kMostSteps + 1, 1>;
  using Normal = Eigen::Matrix<double, kMostSteps + 1, kMostSteps + 1>;
  Heights row = Heights::Zero(), sum = row;
  Normal normal = kTogether * Normal::Identity();
  for (int i = 0; i <= 2 * profile.half; ++i) {
    row[kMostSteps] = 1;
    for (int k = 0; k < profile.n_steps; ++k)
      row[k] = BlurredStep((i - profile.half - shift - profile.places[k]) / sigma_);
    normal += row * row.transpose();
    sum += row * profile.grey[i];
  }
  const Normal inverse = normal.inverse();
  const Heights heights = inverse * sum;
  return {shift, std::max(0.0, profile.variance - heights.dot(sum)), heights[0], inverse(0, 0)};
}

/// The best of a few places, then the lowest point of the parabola through its neighbours.
StepMeter::Fit StepMeter::FitBest(const Profile& profile) const {
  constexpr int kPlaces = static_cast<int>(kFarthest / kStride);
  std::array<Fit, 2 * kPlaces + 1> fits;
  for (int i = 0; i <= 2 * kPlaces; ++i) fits[i] = FitAt(profile, (i - kPlaces) * kStride * sigma_);
  const auto misfit = [](const Fit& a, const Fit& b) { return a.misfit < b.misfit; };
  const auto best = std::min_element(fits.begin(), fits.end(), misfit);
  if (best == fits.begin() || best == fits.end() - 1) return *best;
  const double before = (best - 1)->misfit, after = (best + 1)->misfit;
  const double bend = before - 2 * best->misfit + after;
  if (bend <= 0) return *best;
  return FitAt(profile, best->shift + 0.5 * kStride * sigma_ * (before - after) / bend);
}

double StepMeter::Steepest(const Profile& profile) const {
  double slope = 0;
  for (int i = 1; i < 2 * profile.half; ++i)
    slope = std::max(slope, std::abs(profile.grey[i + 1] - profile.grey[i - 1]) / 2);
  return slope * sigma_ * std::sqrt(2 * kPi);
}

}  // namespace priamos::head
