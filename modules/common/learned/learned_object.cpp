#include "common/learned/learned_object.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/learned/required_place.hpp"

namespace priamos {
namespace {

constexpr double kLeastDepth_m = 0.05;

}  // namespace

void LearnedObject::Describe(Archive& a) {
  a.Integer("id", id, {"-", 1, 1e9, "number of the thing"});
  a.Choice("kind", kind, {"edge", "face", "box"},
           "an upright edge, an upright rectangle, or two of them that meet at an edge");
  a.Number("x_m", x_m, {"m", -200, 200, "map, middle of its front on the floor"});
  a.Number("y_m", y_m, {"m", -200, 200, "map, middle of its front on the floor"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, square to the front, away from where it was seen"});
  a.Number("width_m", width_m, {"m", 0, 10, "of the front"});
  a.Number("depth_m", depth_m, {"m", 0, 10, "behind the front; 0: not known"});
  a.Number("bottom_m", bottom_m, {"m", 0, 10, "above the floor, where it begins"});
  a.Number("top_m", top_m, {"m", 0, 10, "above the floor, where it ends"});
  a.Number("sigma_along_m", sigma_along_m, {"m", 0, 100, "standard deviation of its middle along the front"});
  a.Number("sigma_across_m", sigma_across_m, {"m", 0, 100, "and square to it"});
  a.Number("sigma_yaw_deg", sigma_yaw_deg, {"deg", 0, 180, "standard deviation of its direction"});
  a.Number("seen_s", seen_s, {"s", 0, 1e11, "since 1970, when it was seen last"});
  a.Integer("looks", looks, {"-", 1, 1e9, "how many showed it"});
  RequirePlace(a, "the number of the thing");
}

Rectangle LearnedObject::Footprint() const {
  if (kind == "edge") return {map_from_front(), {0, 0}};
  const double half_m = std::max(depth_m, kLeastDepth_m) / 2;
  return {map_from_front() * Pose2{half_m, 0, 0}, {half_m, width_m / 2}};
}

std::string NameOf(const LearnedObject& object) {
  return fmt::format("thing {}", object.id);
}

std::string SizeOf(const LearnedObject& object) {
  if (object.kind == "edge") return "an edge";
  if (object.kind == "face") return fmt::format("{:.2f} m wide", object.width_m);
  return fmt::format("{:.2f} x {:.2f} m", object.width_m, object.depth_m);
}

}  // namespace priamos
