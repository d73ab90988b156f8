#include "head/core/calibration/discs/disc_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kForeign = 0.1, kForeignLevels = 10;
// What lamps and vignetting do at most, as a standard deviation. It keeps the slopes from being traded
// against the centre where a disc is small or blurred.
constexpr double kSlopePrior_per_px = 0.001;
constexpr double kBackgroundSlopePrior_per_px = 0.2;

/// Phi and phi of the standard normal distribution, tabulated over +-kReach.
class NormalTable {
 public:
  static constexpr double kReach = 3.3;
  NormalTable() {
    for (int i = 0; i <= kSteps; ++i) {
      const int from_middle = i - kSteps / 2;
      const double z = from_middle / kPerUnit;
      cdf_[i] = 0.5 * std::erfc(-z / std::sqrt(2.0));
      pdf_[i] = std::exp(-z * z / 2) / std::sqrt(2 * kPi);
    }
  }
  /// {Phi, phi} at z within +-kReach.
  std::pair<double, double> operator()(double z) const {
    const double x = z * kPerUnit + kSteps / 2.0;
    const int i = std::clamp(static_cast<int>(x), 0, kSteps - 1);
    const double t = x - i;
    return {cdf_[i] + t * (cdf_[i + 1] - cdf_[i]), pdf_[i] + t * (pdf_[i + 1] - pdf_[i])};
  }

 private:
  static constexpr int kSteps = 1024;
  static constexpr double kPerUnit = kSteps / (2 * kReach);
  std::array<double, kSteps + 1> cdf_, pdf_;
};

const NormalTable& Normal() {
  static const NormalTable kTable;
  return kTable;
}

/// Sums the normal equations over the pixels of one disc.
class Accumulator {
 public:
  explicit Accumulator(const DiscModel& model) : m_(model), normal_(Normal()) {
    const double reach = NormalTable::kReach * m_.rim_sigma;
    const Ellipse shape{m_.centre, m_.k.inverse()};
    const double minor = std::max(0.5, shape.SemiMinor());
    const double inner = std::max(0.3, 1 - reach / minor), outer = 1 + reach / minor;
    inside_q2_ = inner * inner;
    outside_q2_ = outer * outer;
  }

  /// The pixel at (dx, dy) from the centre with value `grey`.
  void Add(double dx, double dy, double grey) {
    const double kx = m_.k(0, 0) * dx + m_.k(0, 1) * dy, ky = m_.k(0, 1) * dx + m_.k(1, 1) * dy;
    const double q2 = kx * dx + ky * dy;
    const double shading = m_.amplitude * (1 + m_.slope.x() * dx + m_.slope.y() * dy);
    const double rest = grey - m_.background - m_.background_slope.x() * dx - m_.background_slope.y() * dy;
    if (q2 < inside_q2_) {
      inside_.Add(dx, dy, rest - shading);
    } else if (q2 > outside_q2_) {
      // The ground may end near the disc: what is far from its level belongs to something else.
      if (std::abs(rest) < kForeign * m_.amplitude + kForeignLevels) outside_.Add(dx, dy, rest);
    } else {
      AddRim(dx, dy, kx, ky, q2, rest, shading);
    }
  }

  /// Pixels of which the model knows that they lie inside.
  void AddCore(const GreySums& core, const Vector2d& shift) {
    const Vector2d slope = m_.amplitude * m_.slope + m_.background_slope;
    core.Against(m_.amplitude + m_.background, slope, shift).AddTo(eq_, m_.amplitude);
  }

  NormalEquations Finish() {
    inside_.AddTo(eq_, m_.amplitude);
    outside_.AddTo(eq_, 0);
    return eq_;
  }

 private:
  void AddRim(double dx, double dy, double kx, double ky, double q2, double rest, double shading) {
    const double inverse_norm = 1 / std::sqrt(kx * kx + ky * ky), q = std::sqrt(q2);
    // First-order distance to the rim, positive inside.
    const double z = (1 - q) * q * inverse_norm / m_.rim_sigma;
    const auto [share, density] = normal_(std::clamp(z, -NormalTable::kReach, NormalTable::kReach));
    const double residual = rest - shading * share;
    const double per_distance = m_.amplitude * density / m_.rim_sigma;
    const double per_k = -per_distance * inverse_norm / 2, lit = m_.amplitude * share;
    Vector6d odd, even;
    odd << per_distance * kx * inverse_norm, per_distance * ky * inverse_norm, lit * dx, lit * dy, dx, dy;
    even << share, 1, per_k * dx * dx, 2 * per_k * dx * dy, per_k * dy * dy, -per_distance * z;
    eq_.odd.noalias() += odd * odd.transpose();
    eq_.even.noalias() += even * even.transpose();
    eq_.odd_rhs += residual * odd;
    eq_.even_rhs += residual * even;
    eq_.squares += residual * residual;
    ++eq_.pixels;
  }

  const DiscModel& m_;
  const NormalTable& normal_;
  double inside_q2_, outside_q2_;
  NormalEquations eq_;
  FlatPixels inside_, outside_;
};

Vector6d SolveDamped(Matrix6d m, const Vector6d& rhs) {
  m.diagonal() *= 1 + 1e-6;
  m.diagonal().array() += 1e-12;
  return m.ldlt().solve(rhs);
}

/// The odd equations with the prior of the slopes added.
void AddPrior(const DiscModel& m, NormalEquations& eq) {
  const double variance = std::max(0.5, eq.squares / eq.pixels);
  const double weight = variance / (kSlopePrior_per_px * kSlopePrior_per_px);
  const double ground_weight = variance / (kBackgroundSlopePrior_per_px * kBackgroundSlopePrior_per_px);
  for (int i = 0; i < 2; ++i) {
    eq.odd(2 + i, 2 + i) += weight;
    eq.odd_rhs(2 + i) -= weight * m.slope(i);
    eq.odd(4 + i, 4 + i) += ground_weight;
    eq.odd_rhs(4 + i) -= ground_weight * m.background_slope(i);
  }
}

}  // namespace

void DiscModel::Step(const NormalEquations& eq) {
  const Vector6d odd = SolveDamped(eq.odd, eq.odd_rhs), even = SolveDamped(eq.even, eq.even_rhs);
  centre += odd.head<2>();
  slope += odd.segment<2>(2);
  background_slope += odd.tail<2>();
  amplitude += even(0);
  background += even(1);
  k(0, 0) += even(2);
  k(0, 1) += even(3);
  k(1, 0) += even(3);
  k(1, 1) += even(4);
  rim_sigma = std::clamp(rim_sigma + even(5), 0.28, 6.0);
}

NormalEquations Linearise(const DiscModel& model, const WindowPixels& pixels, const Vector2d& window_centre) {
  Accumulator sums(model);
  const Vector2d shift = window_centre - model.centre;
  for (const auto& p : pixels.shell) sums.Add(p.dx + shift.x(), p.dy + shift.y(), p.grey);
  sums.AddCore(pixels.core, shift);
  NormalEquations eq = sums.Finish();
  if (eq.pixels > 0) AddPrior(model, eq);
  return eq;
}

double RimFade(const DiscModel& model) {
  return NormalTable::kReach * model.rim_sigma;
}

}  // namespace priamos::head
