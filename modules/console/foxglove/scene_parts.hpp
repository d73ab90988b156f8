#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"

/// Parts of the foxglove.* messages, as JSON; lengths in metres.
namespace priamos::console {

using Points = std::vector<Eigen::Vector3d>;

/// Red, green, blue and opacity, 0 to 1.
struct Colour {
  double r = 0, g = 0, b = 0, a = 1;
};
/// The frame an entity stands in. `follows`: it moves with that frame; else it stays where the frame was at
/// the entity's time.
struct EntityFrame {
  const char* name = "map";
  bool follows = false;
};

nlohmann::ordered_json StampJson(Time time);
nlohmann::ordered_json PoseJson(const Pose2& pose, double z_m = 0);
nlohmann::ordered_json ColourJson(const Colour& colour);
/// Lines between consecutive points, or, as `pairs`, between every first and second one.
nlohmann::ordered_json LinesJson(const Points& points, const Colour& colour, bool pairs,
                                 double thickness_m = 0.02);
/// An upright box with its foot at height `z_m`.
nlohmann::ordered_json BoxJson(const Pose2& centre, const Eigen::Vector3d& size_m, const Colour& colour,
                               double z_m = 0);
nlohmann::ordered_json LabelJson(const Eigen::Vector3d& at, const std::string& text, const Colour& colour);
/// An entity without anything in it: "lines", "cubes" and "texts" are to be filled.
nlohmann::ordered_json EntityJson(const std::string& id, const EntityFrame& frame, Time time);
/// An update of these entities.
nlohmann::ordered_json UpdateJson(std::vector<nlohmann::ordered_json> entities);

}  // namespace priamos::console
