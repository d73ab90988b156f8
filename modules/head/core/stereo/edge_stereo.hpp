#pragma once

#include <optional>
#include <vector>

#include "head/core/stereo/space_edge.hpp"
#include "head/core/stereo/stereo_pairs.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// An edge of the scene found in several images.
struct StereoMatch {
  int left = -1;            ///< index in the left view's lines
  std::vector<int> right;   ///< pieces of it in the right view, the best one first; may be broken there
  std::vector<int> third;   ///< pieces of it in the third view; empty if it was not used
  double epipolar_rad = 0;  ///< angle between the edge and the epipolar line, the largest of the camera pairs
  /// Nearly parallel to the epipolar lines of all cameras: the match stands, but nothing determines how far
  /// away the edge is.
  bool is_near_epipolar = false;
  double similarity = 0;           ///< similarity of grey values and common extent, 0..1
  std::optional<SpaceEdge> space;  ///< nullopt if is_near_epipolar
};

/// Matches the lines of two rectified or unrectified views by the epipolar constraint on the ends of edges,
/// the sign of contrast, the grey values on both sides and the common extent. Each line is used once, except
/// that pieces of one broken line share their partner. Ambiguous ones go to the most similar partner.
std::vector<StereoMatch> MatchBinocular(const CameraView& left, const CameraView& right,
                                        const StereoOptions& options);

/// Matches the lines of three views. The corresponding point is where the epipolar lines of two others cross,
/// so only matches that all three images confirm are returned; edges along one pair's epipolar lines are
/// reconstructed from another pair.
std::vector<StereoMatch> MatchTrinocular(const CameraView& left, const CameraView& right,
                                         const CameraView& third, const StereoOptions& options);

}  // namespace priamos::head
