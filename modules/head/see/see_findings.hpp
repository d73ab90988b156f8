#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "head/core/bodies/free_model_fix.hpp"
#include "head/core/contours/contour_graph.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/stereo/edge_stereo.hpp"
#include "head/see/find_doors.hpp"
#include "head/see/see_options.hpp"

namespace priamos::head {

/// An image and what is in it alone.
struct SeenPhotograph {
  std::string file;
  cv::Mat grey;
  EdgeImage edges;
  double blur_px = 0;  ///< BlurredEdges::MedianBlur of a soft one
  ContourGraph contours;
};

/// A body that was looked for, in the frame of the first camera.
struct SeenLandmark {
  Polyhedron body;
  Eigen::Isometry3d believed;
  FreeModelFix fix;
};

/// All that was found. `views` refer to `photographs` and `cameras`: it is moved, never copied.
struct SeeFindings {
  std::vector<SeenPhotograph> photographs;
  std::string note;                  ///< how images of more than 8 bits were scaled, if any was
  std::vector<CameraModel> cameras;  ///< cameras of the photographs, or none
  std::vector<CameraView> views;     ///< by camera
  std::optional<std::vector<StereoMatch>> matches;  ///< with two or three cameras
  std::optional<SeenDoors> doors;                   ///< with SeeOptions::doors or stand
  std::optional<SeenLandmark> landmark;             ///< with SeeOptions::landmark

  SeeFindings() = default;
  SeeFindings(SeeFindings&&) = default;
  SeeFindings& operator=(SeeFindings&&) = default;

  std::vector<cv::Mat> Greys() const;
};

/// Reads what `options` names and computes what they ask for; writes nothing. Throws std::runtime_error
/// naming a file that cannot be read or does not fit the others, and images that were exchanged.
SeeFindings FindAll(const SeeOptions& options);

/// Matches with a place in space: the others run along the epipolar lines.
int CountInSpace(std::span<const StereoMatch> matches);

}  // namespace priamos::head
