#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/outcome.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/edges/photograph_edges.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// The cameras, once the size of the images is known, and what they see in the images of a moment.
class Eyes {
 public:
  /// `files`: calibrations of `n` cameras, one for each image of a moment.
  Eyes(std::vector<std::string> files, bool are_rectified, std::size_t n)
      : files_(std::move(files)), are_rectified_(are_rectified), n_(n) {}

  /// Reads the images of one moment; why that cannot be done, nullopt if it was. Throws ConfigError for
  /// cameras that cannot be used (also two at one place), and for a file that is named twice.
  std::optional<Refusal> Read(const std::vector<std::string>& names);
  bool has_seen() const { return !cameras_.empty(); }

  /// Finds the edges of the images read last.
  std::span<const CameraView> Look();

  const cv::Mat& first() const { return greys_.front(); }
  std::span<const CameraView> views() const { return views_; }

 private:
  std::vector<CameraModel> Cameras(const std::vector<std::string>& names);

  std::vector<std::string> files_;
  bool are_rectified_;
  std::size_t n_;
  cv::Size size_{};
  std::vector<cv::Mat> greys_;
  std::vector<CameraModel> cameras_;
  std::vector<BlurredEdges> edges_;  ///< the views point to them
  std::vector<CameraView> views_;
};

}  // namespace priamos::head
