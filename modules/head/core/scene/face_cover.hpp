#pragma once

#include <Eigen/Core>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// The smaller share that both images show of an edge of space, of its part that lies in the picture,
/// whatever its contrast along it; 0 where less than 16 px of it are in a picture.
double CoverInBoth(const StereoViews& views, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
/// The same of one image.
double CoverIn(const CameraView& view, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// How lines end beside the ends of an edge that they cover.
enum class EndRule {
  kReach,  ///< not before them: they may run on
  kStop,   ///< there
};

/// How near to the end of an edge that is: in the image, or as a share of its length there if that is more.
struct EndTolerance {
  double px = 8, share = 0.12;
  double cut_px = 0;  ///< at the border of an image, where lines end without their edges: if that is more
};

/// Whether, in both images, the lines that cover an edge end as the rule says.
bool EndsInBoth(const StereoViews& views, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                EndRule rule, const EndTolerance& tolerance);
/// The same of one image.
bool EndsIn(const CameraView& view, const Eigen::Vector3d& from, const Eigen::Vector3d& to, EndRule rule,
            const EndTolerance& tolerance);

}  // namespace priamos::head
