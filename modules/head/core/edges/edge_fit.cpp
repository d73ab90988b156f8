#include "head/core/edges/edge_fit.hpp"

#include <algorithm>
#include <cstddef>
#include <opencv2/core/hal/intrin.hpp>

#include "common/square.hpp"

namespace priamos::head {
namespace {

using Lanes = cv::v_float32x4;
static_assert(offsetof(EdgeSums, inverse) == 3 * sizeof(float) &&
                  offsetof(EdgeSums, sharpness) == 6 * sizeof(float),
              "Load takes four numbers at a time");
constexpr double kCorner_px = 0.2;          ///< how far a corner bends the edge that ends there
constexpr double kMinShare = 0.25;          ///< share of the mean strength below which a block is a gap
constexpr double kLeastVariance_px2 = 0.5;  ///< least variance of an edge seen through the narrow kernels

Lanes All(double value) {
  return cv::v_setall_f32(static_cast<float>(value));
}

/// Distances of four blocks from the fit.
struct Misfit {
  explicit Misfit(const EdgeOffset& fit, float begin)
      : offset(All(fit.offset - fit.slope * (fit.centroid - begin))), slope(All(fit.slope)) {}
  Lanes operator()(const Lanes& shift, const Lanes& along) const { return shift - offset - slope * along; }

  Lanes offset, slope;
};

}  // namespace

void EdgeFitter::Load(const EdgeBlocks& blocks, const AxisLine& line, double noise_sigma) {
  static const EdgeSums kNothing{.rows = 1};
  for (const KernelWidth width : {KernelWidth::kWide, KernelWidth::kNarrow})
    noise_[int(width)] = Square(noise_sigma) * line.kernels(width).second_gain;
  narrower_by_ = Square(line.wide->sigma_px) - Square(line.narrow->sigma_px);
  const Lanes gap = All(kMinShare * blocks.mean_strength());
  const auto all = blocks.all();
  total_ = blocks.total();
  n_ = static_cast<int>(all.size());
  padded_ = (n_ + 3) / 4 * 4;
  begin_ = n_ > 0 ? all[0].along : 0;
  for (int i = 0; i < padded_; i += 4) {
    Lanes from[4], from2[4], along, rows, strength, inverse, wide, narrow, unused;
    for (int k = 0; k < 4; ++k) {
      const EdgeSums& b = i + k < n_ ? all[i + k] : kNothing;
      from[k] = cv::v_load(&b.along);
      from2[k] = cv::v_load(b.imbalance);
    }
    cv::v_transpose4x4(from[0], from[1], from[2], from[3], along, rows, strength, inverse);
    cv::v_transpose4x4(from2[0], from2[1], from2[2], from2[3], wide, narrow, unused, unused);
    cv::v_store(&along_[i], along - All(begin_));
    cv::v_store(&rows_[i], rows);
    cv::v_store(&strengths_[i], strength & (strength > gap * rows));
    cv::v_store(&inverses_[i], inverse);
    cv::v_store(&imbalances_[0][i], wide * inverse);
    cv::v_store(&imbalances_[1][i], narrow * inverse);
  }
}

/// Imbalance per strength and pixel of shift, also while the line lies beside the edge. With what is right
/// for a Gaussian edge of variance v, seen from the distance d through the wide kernels: imbalance / strength
/// is d / v, sharpness / strength (1 - d^2 / v) / v.
double EdgeFitter::Kappa(KernelWidth width) const {
  const double wide = total_.sharpness[0] / total_.strength + Square(total_.imbalance[0] / total_.strength);
  if (width == KernelWidth::kWide) return wide;
  const double distance = total_.imbalance[0] / total_.strength / wide;
  const double variance = std::max(1 / wide - narrower_by_, kLeastVariance_px2);
  return total_.sharpness[1] / total_.strength / std::max(1 - Square(distance) / variance, 0.5);
}

bool EdgeFitter::Solve(KernelWidth width, int rounds, EdgeOffset& fit) {
  const int k = static_cast<int>(width);
  fit = EdgeOffset{.width = width};
  if (n_ < 3 || total_.sharpness[k] <= 0 || total_.sharpness[0] <= 0 || total_.strength <= 0) return false;
  fit.kappa = Kappa(width);
  const Lanes per_imbalance = All(1 / fit.kappa), farthest = All(EdgeBlocks::kMaxShift_px);
  for (int i = 0; i < padded_; i += 4) {
    const Lanes shift = cv::v_load(&imbalances_[k][i]) * per_imbalance;
    cv::v_store(&shifts_[i], cv::v_max(cv::v_min(shift, farthest), All(0) - farthest));
  }
  SetWeights(fit);
  for (int round = 0; round < rounds; ++round) {
    if (round > 0 && !Reweight(fit)) return true;
    if (!FitLine(fit)) return false;
  }
  return true;
}

/// Corners disturb the ends: a loss worth taking unless a block's own noise is larger.
void EdgeFitter::SetWeights(const EdgeOffset& fit) {
  std::copy_n(strengths_.begin(), padded_, base_.begin());
  const double block_noise =
      std::sqrt(noise(fit.width) * total_.rows / n_) * n_ / (fit.kappa * total_.strength);
  if (n_ >= 8 && block_noise < kCorner_px) base_[0] = base_[n_ - 1] = 0;
  std::copy_n(base_.begin(), padded_, weights_.begin());
}

bool EdgeFitter::FitLine(EdgeOffset& fit) const {
  Lanes w = All(0), wt = w, wtt = w, ws = w, wts = w;
  for (int i = 0; i < padded_; i += 4) {
    const Lanes weight = cv::v_load(&weights_[i]), t = cv::v_load(&along_[i]), s = cv::v_load(&shifts_[i]);
    const Lanes moment = weight * t;
    w += weight;
    wt += moment;
    wtt += moment * t;
    ws += weight * s;
    wts += moment * s;
  }
  const float weight = cv::v_reduce_sum(w), shift = cv::v_reduce_sum(ws);
  if (weight <= 0) return false;
  const float mean = cv::v_reduce_sum(wt) / weight;
  const float spread = cv::v_reduce_sum(wtt) - mean * mean * weight;
  if (spread <= 0) return false;
  fit.centroid = begin_ + mean;
  fit.offset = shift / weight;
  fit.slope = (cv::v_reduce_sum(wts) - mean * shift) / spread;
  return true;
}

/// Huber weights from the last fit; false if no block is an outlier.
bool EdgeFitter::Reweight(const EdgeOffset& fit) {
  constexpr double kLimit = 2.5, kFloor_px = 0.03;
  const Misfit misfit_of(fit, begin_);
  const Lanes kappa = All(fit.kappa), per_row = All(kLimit * kLimit * noise(fit.width));
  const Lanes floor = All(Square(kLimit * kFloor_px));
  bool any = false;
  for (int i = 0; i < padded_; i += 4) {
    const Lanes slope = kappa * cv::v_load(&base_[i]);
    const Lanes error = slope * misfit_of(cv::v_load(&shifts_[i]), cv::v_load(&along_[i]));
    const Lanes misfit = error * error;
    const Lanes allowed = per_row * cv::v_load(&rows_[i]) + floor * slope * slope;
    any |= cv::v_check_any(misfit > allowed);
    cv::v_store(&misfits_[i], misfit);
    cv::v_store(&allowed_[i], allowed);
  }
  if (!any) return false;
  for (int i = 0; i < padded_; i += 4) {
    const Lanes allowed = cv::v_load(&allowed_[i]);
    const Lanes robust = cv::v_sqrt(allowed / cv::v_max(allowed, cv::v_load(&misfits_[i])));
    cv::v_store(&weights_[i], robust * cv::v_load(&base_[i]));
  }
  return true;
}

void EdgeFitter::AddVariance(EdgeOffset& fit) const {
  const Misfit misfit_of(fit, begin_);
  const Lanes centroid = All(fit.centroid - begin_), per_kappa = All(1 / fit.kappa),
              per_row = All(noise(fit.width));
  Lanes w = All(0), wtt = w, v = w, vtt = w, chi2 = w, n = w;
  for (int i = 0; i < padded_; i += 4) {
    const Lanes weight = cv::v_load(&weights_[i]), along = cv::v_load(&along_[i]), tau = along - centroid;
    const Lanes counts = weight > All(0), per_strength = per_kappa * cv::v_load(&inverses_[i]);
    const Lanes variance = per_row * cv::v_load(&rows_[i]) * per_strength * per_strength;  // of a shift
    const Lanes noisy = weight * weight * variance, error = misfit_of(cv::v_load(&shifts_[i]), along);
    w += weight;
    wtt += weight * tau * tau;
    v += noisy;
    vtt += noisy * tau * tau;
    chi2 += counts & (error * error / variance);
    n += counts & All(1);
  }
  const double count = cv::v_reduce_sum(n), weight = cv::v_reduce_sum(w), spread = cv::v_reduce_sum(wtt);
  const double inflation = count > 4 ? std::clamp(cv::v_reduce_sum(chi2) / (count - 2), 1.0, 25.0) : 1.0;
  fit.variance_offset = inflation * cv::v_reduce_sum(v) / (weight * weight);
  fit.variance_slope = inflation * cv::v_reduce_sum(vtt) / (spread * spread);
}

}  // namespace priamos::head
