#pragma once

#include <string>
#include <vector>

namespace priamos::head {

/// Which photographs to look at, and for what; no robot needed.
struct SeeOptions {
  std::vector<std::string> images;  ///< files OpenCV can read
  /// Files of the cameras (LoadCameras) of two or three images of one scene: one for each, or one for all.
  std::vector<std::string> cameras{};
  bool are_rectified = false;  ///< the images were rectified by the projection matrices of `cameras`
  /// A free landmark model (LoadPolyhedron) to look for; needs cameras, one is enough.
  std::string landmark{};
  std::vector<double> at{};        ///< where it is believed to be (PoseFromSix)
  bool doors = false;              ///< doors are looked for; how the cameras stand is found, too
  std::vector<double> stand{};     ///< how the first camera stands (StandFrom): doors are looked for
  double max_door_width_m = 1.35;  ///< double doors are wider
  std::string output{};  ///< folder or file for the drawings; empty: beside their images (SeeOutput)
  bool force = false;    ///< replaces files that are there already, but never an image that is read
  std::string json{};    ///< file for all that was found; "-": into SeeReport::json; empty: none
};

}  // namespace priamos::head
