#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace priamos::head {

/// Which body is looked for in which images.
struct LocateOptions {
  std::vector<std::string> images;   ///< ImageNames; images of one moment, one of each camera, in turn
  std::vector<std::string> cameras;  ///< LoadCameras
  int n_at_once = 0;                 ///< images of one moment; 0: as many as files of cameras
  bool are_rectified = false;        ///< the images were rectified by the cameras' projection matrices
  std::string model;                 ///< LoadPolyhedron
  double scale = 1;                  ///< metres per unit of the model's file
  double model_sigma_m = 0.0008;     ///< how exact the model is, each axis of an edge
  std::vector<double> at;            ///< where the body is in the beginning (PoseFromSix)
  double prior_percent = 3.5,
         prior_deg = 1.7;  ///< how well that is known: of the distance, and about each axis
  double motion_percent = 3.5, motion_deg = 1.7;  ///< how far it moves from one moment to the next
  std::string json{};  ///< file for a line of JSON per moment; "-": LocateSinks::json
  std::string draw{};  ///< folder for a drawing per moment, IMAGE-body.png; empty: none
  bool force = false;  ///< replaces files that are there already, but never an image that is read
};

/// Where results go while they come: whole lines.
struct LocateSinks {
  std::function<void(const std::string&)> text;
  std::function<void(const std::string&)> json;  ///< with LocateOptions::json "-"
};

/// How many moments there were, and in how many the body was found.
struct LocateTally {
  int n_moments = 0, n_found = 0;
};

/// Looks for the body in all images, moment by moment (BodyTracker). An image that cannot be read is a moment
/// without the body, with the reason. `lines` gives the names of images for "-". Throws std::runtime_error
/// with one sentence for what cannot be used, and when no image could be read.
LocateTally Locate(const LocateOptions& options, std::istream& lines, const LocateSinks& sinks);

}  // namespace priamos::head
