#pragma once

#include <vector>

#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// Two lines of two views that can be the same edge.
struct StereoPair {
  int first = 0, second = 0;
  double similarity = 0;    ///< 0..1
  double epipolar_rad = 0;  ///< angle between line and epipolar line, the smaller of both images
};

/// All of them: whoever knows more has to choose.
std::vector<StereoPair> FindPairs(const CameraView& first, const CameraView& second,
                                  const StereoOptions& options);

/// How alike the grey values are, 0 (too different) to 1.
double GreySimilarity(const CameraView& a, int line_a, const CameraView& b, int line_b,
                      const StereoOptions& options);

}  // namespace priamos::head
