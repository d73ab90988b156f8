#pragma once

#include <Eigen/Core>
#include <vector>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// Two lines that may be one edge: numbers of CameraView::lines.
struct LinePair {
  int first = 0, second = 0;
};

/// How the grey values of one camera become those of another that sees the same: exposure, black level, tone
/// curve, and the light that either lens loses towards the corners.
struct GreyRelation {
  double gain = 1;                               ///< of white
  double gamma = 1;                              ///< exponent of the tone curve
  double offset = 0;                             ///< grey value of what is black in the first image
  double falloff_first = 0, falloff_second = 0;  ///< change of the gain from centre to corner of either image

  /// Grey value in the second image of what has `grey` in the first, 0 to 255. `far_first` and `far_second`
  /// are FarFromCentre of the places.
  double Of(double grey, double far_first = 0, double far_second = 0) const;
  /// Change of the second grey value over that of the first, of a middle grey.
  double Slope(double far_first = 0, double far_second = 0) const;
};

/// Square of the distance from the centre of the picture, 1 in the corners.
double FarFromCentre(const CameraView& view, const ViewLine& line);

/// The relation under which most lines of the first image have a partner with their grey values among
/// `pairs`. As cameras are (no change) unless another relation explains clearly more lines.
GreyRelation EstimateGreyRelation(const CameraView& first, const CameraView& second,
                                  const std::vector<LinePair>& pairs);

}  // namespace priamos::head
