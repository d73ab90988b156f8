#pragma once

#include <string>

#include "head/see/see_options.hpp"

namespace priamos::head {

/// What a person is answered.
struct SeeReport {
  bool found = true;  ///< false: a landmark was asked for and not found, or doors and not which way is up
  std::string text;   ///< what was found, and where each drawing lies; whole lines
  std::string notes;  ///< what was done to the images before they were looked at; whole lines, mostly none
  std::string json;   ///< all that was found, when SeeOptions::json is "-"
};

/// Draws edges, corners and outlines of each image, with SeeOptions::cameras also what the images have in
/// common, and writes the drawings (IMAGE-edges.png, and of the first image -stereo, -doors and -landmark)
/// and the list of all that was found. Prints nothing. Throws std::runtime_error naming a file that cannot be
/// read, does not fit the others, cannot or may not be written; then nothing has been written. An image in
/// which nothing can be seen is named with the reason, and so are images that were exchanged.
SeeReport See(const SeeOptions& options);

}  // namespace priamos::head
