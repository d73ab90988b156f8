#pragma once

#include <string>
#include <vector>

namespace priamos::head {

/// What seeing finds in photographs; no robot needed.
struct SeeOptions {
  std::vector<std::string> images;  ///< files OpenCV can read
  std::vector<std::string>
      cameras{};  ///< projection files (LoadProjection) of two or three images of one scene
  std::string
      landmark{};  ///< a free landmark model (LoadPolyhedron) to look for; needs cameras, one is enough
  std::vector<double> at{};        ///< where it is believed to be (PoseFromSix)
  std::vector<double> stand{};     ///< how the first of two cameras stands (OnTheFloor): doors are looked for
  double max_door_width_m = 1.35;  ///< double doors are wider
  std::string output{};  ///< folder or file for the drawings; empty: beside their images (SeeOutput)
  bool force = false;    ///< replaces files that are there already, but never an image that is read
  std::string json{};    ///< file for all that was found; "-": into SeeReport::json; empty: none
};

/// What a person is answered.
struct SeeReport {
  bool found = true;  ///< false: a landmark was asked for and not found
  std::string text;   ///< what was found, and where each drawing lies; whole lines
  std::string json;   ///< all that was found, when SeeOptions::json is "-"
};

/// Draws edges, corners and outlines of each image, with `cameras` also what the images have in common, and
/// writes the drawings (IMAGE-edges.png, and of the first image -stereo, -doors and -landmark) and the list
/// of all that was found. Prints nothing. Throws std::runtime_error naming a file that cannot be read, does
/// not fit the others, cannot or may not be written; then nothing has been written. An image in which nothing
/// can be seen is named with the reason, and so are images that were exchanged.
SeeReport See(const SeeOptions& options);

}  // namespace priamos::head
