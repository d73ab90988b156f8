#pragma once

#include <array>
#include <cmath>
#include <span>

#include "head/core/edges/edge_blocks.hpp"

namespace priamos::head {

/// Where an edge lies beside the line along which it was measured.
struct EdgeOffset {
  KernelWidth width = KernelWidth::kWide;  ///< the kernels that it was found with
  double centroid = 0;                     ///< row of the weighted mean
  double offset = 0, slope = 0;            ///< from the line to the edge; the offset holds at the centroid
  double variance_offset = 0, variance_slope = 0;
  double kappa = 1;  ///< imbalance per strength and pixel of shift

  /// How far the ends of a line move that reaches `half` to both sides [px].
  double Move(double half) const { return std::abs(offset) + std::abs(slope) * half; }
};

/// The straight line through the blocks of an edge: weighted least squares, in which blocks that disagree
/// lose weight. All of it runs over four blocks at a time.
class EdgeFitter {
 public:
  /// Takes the blocks to fit; `blocks` were measured along `line`, in an image whose pixels have noise of
  /// `noise_sigma`.
  void Load(const EdgeBlocks& blocks, const AxisLine& line, double noise_sigma);
  /// Fits the edge once with equal weights, then with robust ones. False if the blocks do not determine it.
  bool Solve(KernelWidth width, int rounds, EdgeOffset& fit);
  /// Sets the variances of `fit` from the noise, enlarged where the blocks scatter more than that explains.
  void AddVariance(EdgeOffset& fit) const;

  /// Variance that the pixels' noise gives the second derivative of a row.
  double noise(KernelWidth width) const { return noise_[int(width)]; }
  /// Distance of the edge in block `i` from the line [px], in the last solution.
  float shift(std::size_t i) const { return shifts_[i]; }
  /// Weight of block `i` in the last solution.
  float weight(std::size_t i) const { return weights_[i]; }

 private:
  double Kappa(KernelWidth width) const;
  void SetWeights(const EdgeOffset& fit);
  bool FitLine(EdgeOffset& fit) const;
  bool Reweight(const EdgeOffset& fit);

  using Numbers = std::array<float, EdgeBlocks::kMaxBlocks + 4>;
  EdgeSums total_;
  double noise_[2] = {0, 0};  ///< noise(), by kernel width
  double narrower_by_ = 0;    ///< difference of the two kernels' variances [px^2]
  float begin_ = 0;           ///< row that along_ counts from
  /// Number of blocks; the same rounded up to a multiple of 4 (padding has weight 0).
  int n_ = 0, padded_ = 0;
  alignas(16) Numbers along_, rows_, strengths_, inverses_, imbalances_[2];  ///< imbalance per strength
  alignas(16) Numbers shifts_, base_, weights_;  ///< weights before and after robust weighting
  alignas(16) Numbers misfits_, allowed_;
};

}  // namespace priamos::head
