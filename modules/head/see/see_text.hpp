#pragma once

#include <span>
#include <string>

#include "head/see/see_findings.hpp"

namespace priamos::head {

/// What was found, in lines for a person. `drawing` is the file where it is drawn.

/// Findings in one image: how many segments, corners and parallelograms, and why nothing can be seen if so.
std::string EdgesText(const SeenPhotograph& photograph, const std::string& drawing);

/// How many edges two or three images have in common, and how many of them have a place in space.
std::string MatchesText(std::span<const StereoMatch> matches, const std::string& drawing);

/// How many doors; each with place [m, deg], size and standard deviation of its middle [m].
std::string DoorsText(std::span<const DetectedDoor> doors, const std::string& drawing);

/// Pose of the body in `model_file` (x y z [m], roll pitch yaw [deg]), or the reason why it was not found.
std::string LandmarkText(const std::string& model_file, const FreeModelFix& fix, const std::string& drawing);

}  // namespace priamos::head
