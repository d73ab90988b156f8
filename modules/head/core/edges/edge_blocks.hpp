#pragma once

#include <cmath>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "head/core/edges/edge_profile.hpp"

namespace priamos::head {

/// Measures an edge along a line block by block, a few rows each, and finds how far it goes.
class EdgeBlocks {
 public:
  static constexpr double kMaxShift_px = 1.5;  ///< an edge farther beside the line is another one
  static constexpr std::size_t kMaxBlocks = 1024;

  /// Sets the image to measure (CV_8UC1), which is referred to until the next call.
  void SetImage(const cv::Mat& image) { profile_.SetImage(image); }

  /// Chooses the number of rows per block for lines of about `n_rows`.
  void ChooseSize(int n_rows);
  /// Measures the rows (or columns) from `first` to `last`.
  void Measure(const AxisLine& line, int first, int last);
  /// Follows the edge to both sides as far as it goes, then drops the blocks at both ends that do not show
  /// it. The ends of the edge lie where half of its strength is lost. False if no block is left.
  bool FindEnds(const AxisLine& line);

  /// The blocks, in ascending order along the line.
  std::span<const EdgeSums> all() const { return blocks_; }
  /// Sum of all blocks.
  const EdgeSums& total() const { return total_; }
  /// Mean edge strength of a row before FindEnds.
  float mean_strength() const { return mean_strength_; }
  /// Ends of the edge along the line, found by FindEnds.
  double first() const { return first_; }
  double last() const { return last_; }

 private:
  bool IsEdge(const EdgeSums& block) const;
  void Extend(const AxisLine& line);
  void Trim();
  float MeanInside() const;

  EdgeProfile profile_;
  int block_rows_ = 4;
  std::vector<EdgeSums> blocks_, front_;
  EdgeSums total_;
  float mean_strength_ = 0, farthest_ = 0;  ///< edge strength of a row; largest imbalance per strength
  double first_ = 0, last_ = 0;
};

}  // namespace priamos::head
