#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>
#include <string>

#include "head/see/find_doors.hpp"
#include "head/see/see_page.hpp"

namespace priamos::head {

/// The image with its edges (thin), the horizon if it is in it, and the doors: uprights and lintel, numbered
/// from 1.
SeePage DrawImageDoors(const cv::Mat& grey, const SeenDoors& seen);

/// Corners and feet [px of the image], direction, shape, range and standard deviations of each door.
nlohmann::ordered_json ImageDoorsToJson(const SeenDoors& seen);

/// How the cameras stand, with standard deviations, and what told the height; or why that is not known.
nlohmann::ordered_json StandToJson(const SeenDoors& seen);

/// The same in a line, empty if all of it was told.
std::string StandText(const SeenDoors& seen);

/// How many doors; each with direction, range and shape. `drawing` is the file where they are drawn.
std::string ImageDoorsText(const SeenDoors& seen, const std::string& drawing);

}  // namespace priamos::head
