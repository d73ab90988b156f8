#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "head/core/edge_profile.hpp"
#include "head/core/edge_segment.hpp"

namespace priamos::head {

/// Brings rough lines to sub-pixel accuracy on the raw image, and finds where they end.
///
/// Along every row that a steep line crosses (every column for a flat one) the grey values are weighted with
/// derivatives of a Gaussian centred on the line. The edge is where the second derivative vanishes; summed
/// over rows this is linear in the grey values, so noise averages out with the length, without the bias of
/// peaks taken pixel by pixel. Two widths are measured: the wide one is less noisy, the narrow one less
/// disturbed by neighbouring edges; where they contradict each other the narrow one is believed.
class EdgeRefiner {
 public:
  struct Options {
    double min_length_px = 12;
    double min_contrast = 4;      ///< grey values; noise may demand more
    double min_significance = 6;  ///< mean contrast over its standard deviation
    double max_spread_px = 2.8;   ///< blur of kernel and edge together; softer ones are shadows
    double floor_px = 0.005;      ///< systematic part of sigma_normal_px: sampling, shading
  };

  /// Refers to `image` (CV_8UC1) until the next call.
  void SetImage(const cv::Mat& image, double noise_sigma);

  /// Appends to `out` the segment near `rough` and its points; false if there is none.
  bool Refine(const RoughLine& rough, const Options& options, EdgeImage& out);

 private:
  struct Fit {
    KernelWidth width = KernelWidth::kWide;
    double centroid = 0;                     ///< row of the weighted mean
    double step_offset = 0, step_slope = 0;  ///< from the measured line to the edge; the offset holds there
    double variance_offset = 0, variance_slope = 0;
    double kappa = 1;  ///< imbalance per strength and pixel of shift

    /// How far the ends of a line move that reaches `half` to both sides [px].
    double Move(double half) const { return std::abs(step_offset) + std::abs(step_slope) * half; }
  };

  void MeasureBlocks(const AxisLine& line, int first, int last);
  bool IsClear(const AxisLine& line, const Options& options) const;
  void SetLimits();
  void Extend(const AxisLine& line);
  void Trim();
  bool IsEdge(const EdgeSums& block) const;
  bool Solve(const AxisLine& line, KernelWidth width, int rounds, Fit& fit);
  void Collect();
  bool FitLine(Fit& fit) const;
  bool Reweight(const AxisLine& line, const Fit& fit);
  void AddVariance(const AxisLine& line, Fit& fit) const;
  bool Choose(const AxisLine& line, Fit& fit);
  void Append(const AxisLine& line, const Fit& fit, const Options& options, EdgeImage& out) const;

  EdgeProfile profile_;
  double noise_sigma_ = 0;
  int block_rows_ = 4;
  std::vector<EdgeSums> blocks_, front_;  ///< along the line, from its small end to its large end
  /// Of any length up to the longest edge, without a heap.
  static constexpr int kMaxBlocks = 1024;
  using BlockArray = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxBlocks, 1>;
  BlockArray along_, rows_, strengths_, imbalances_[2];  ///< of blocks_; imbalance per strength
  BlockArray shifts_, base_, weights_;  ///< of the last solution; weights before and after doubts
  BlockArray misfits_, allowed_;
  EdgeSums total_;
  float mean_strength_ = 0, farthest_ = 0;  ///< of a row; largest imbalance per strength
  double first_ = 0, last_ = 0;             ///< ends of the edge along the line
};

}  // namespace priamos::head
