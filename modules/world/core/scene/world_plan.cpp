#include "world/core/scene/world_plan.hpp"

#include <cmath>

#include "common/random.hpp"
#include "world/core/camera/optics.hpp"

namespace priamos::world {

void DoorWork::Describe(Archive& a) {
  NotePlace(a, place);
  a.Integer("id", id, {"-", kFirstLandmarkId, kLastLandmarkId, "the door's id in the map"});
  a.Choice("hinge", hinge, {"left", "right"}, "side of the hinges, seen in driving direction");
  a.Number("open_deg", open_deg, {"deg", 0, 175, "opening angle of the leaf into the far room, 0 is closed"});
  a.Number("open_spread_deg", open_spread_deg,
           {"deg", 0, 45, "it is off by up to this, drawn from the seed"});
  a.Number("leaf_thickness_m", leaf_thickness_m, {"m", 0.01, 0.1, "thickness of the leaf"});
  a.Number("threshold_m", threshold_m, {"m", 0, 0.02, "height of the threshold, 0 for none"});
  a.Number("built_dx_m", built_dx_m,
           {"m", -0.5, 0.5, "true door against the map, along the map's door frame"});
  a.Number("built_dy_m", built_dy_m,
           {"m", -0.5, 0.5, "true door against the map, along the map's door frame"});
  a.Number("built_dyaw_deg", built_dyaw_deg, {"deg", -20, 20, "true door against the map"});
  a.Number("built_dwidth_m", built_dwidth_m, {"m", -0.5, 0.5, "true clear width against the map"});
  a.Number("built_dheight_m", built_dheight_m, {"m", -0.5, 0.5, "true clear height against the map"});
  a.Number("built_dframe_m", built_dframe_m, {"m", -0.1, 0.1, "true breadth of the frame against the map"});
  a.Number("built_dprotrusion_m", built_dprotrusion_m,
           {"m", -0.1, 0.1, "how far the frame stands before the wall, against the map"});
  a.Number("built_dthickness_m", built_dthickness_m,
           {"m", -0.1, 0.1, "true thickness of the wall at the door against the map"});
  a.List("swings", swings, "how somebody moves the leaf while the robot is there");
}

void BoxPlan::Describe(Archive& a) {
  a.Text("name", name, "for messages");
  a.Number("x_m", x_m, {"m", -100, 100, "map, middle"});
  a.Number("y_m", y_m, {"m", -100, 100, "map, middle"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, direction of its length"});
  a.Number("length_m", length_m, {"m", 0.005, 50, "along its own x axis"});
  a.Number("width_m", width_m, {"m", 0.005, 50, "along its own y axis"});
  a.Number("height_m", height_m, {"m", 0.001, 10, "from its bottom to its top"});
  a.Number("bottom_m", bottom_m, {"m", 0, 10, "height of its bottom above the floor"});
  a.Choice("material", material, MaterialNames(), "how it looks and echoes");
  a.Number("spread_m", spread_m, {"m", 0, 5, "x and y are off by up to this, drawn from the seed"});
  a.Number("spread_deg", spread_deg, {"deg", 0, 180, "yaw is off by up to this, drawn from the seed"});
}

void PosterPlan::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("wall", wall, "name of the wall in the map");
  a.Choice("face", face, {"left", "right"}, "side of the wall, looking from its from_m to its to_m");
  a.Number("along_m", along_m, {"m", 0, 200, "middle of the poster, distance from from_m"});
  a.Number("bottom_m", bottom_m, {"m", 0, 10, "height of its lower edge"});
  a.Number("width_m", width_m, {"m", 0.02, 10, "width"});
  a.Number("height_m", height_m, {"m", 0.02, 10, "height"});
  a.Choice("material", material, MaterialNames(), "how it looks and echoes");
}

void SkirtingPlan::Describe(Archive& a) {
  a.Number("height_m", height_m, {"m", 0, 0.5, "height, 0 for none"});
  a.Number("thickness_m", thickness_m, {"m", 0.001, 0.1, "how far it stands before the wall"});
  a.Choice("material", material, MaterialNames(), "how it looks");
}

void WallSurface::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("wall", wall, "name of the wall in the map");
  a.Choice("material", material, MaterialNames(), "how it looks and echoes");
}

void StartPlan::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -100, 100, "map, middle of the nominal start"});
  a.Number("y_m", y_m, {"m", -100, 100, "map, middle of the nominal start"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, middle of the nominal heading"});
  a.Number("x_spread_m", x_spread_m, {"m", 0, 10, "the nominal start is off by up to this"});
  a.Number("y_spread_m", y_spread_m, {"m", 0, 10, "the nominal start is off by up to this"});
  a.Number("yaw_spread_deg", yaw_spread_deg, {"deg", 0, 180, "the nominal heading is off by up to this"});
  a.Number("error_m", error_m, {"m", 0, 2, "the robot truly stands up to this far from the nominal start"});
  a.Number("error_deg", error_deg, {"deg", 0, 90, "and is turned against it by up to this"});
  a.Flag("anywhere", anywhere,
         "it truly stands at any free place of the map, turned anyhow; error_m and error_deg do not count");
}

Start DrawStart(const StartPlan& plan, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "start");
  const auto within = [&rng](double spread) { return rng.Uniform(-spread, spread); };
  Start start;
  start.nominal = {plan.x_m + within(plan.x_spread_m), plan.y_m + within(plan.y_spread_m),
                   WrapAngle(Radians(plan.yaw_deg + within(plan.yaw_spread_deg)))};
  // The square root makes the density even over the disc.
  const double radius = plan.error_m * std::sqrt(rng.Uniform(0, 1));
  const double bearing = rng.Uniform(-kPi, kPi);
  start.truth = {start.nominal.x + radius * std::cos(bearing), start.nominal.y + radius * std::sin(bearing),
                 WrapAngle(start.nominal.yaw + Radians(within(plan.error_deg)))};
  return start;
}

void ReferencePlan::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("object", object, "file that describes the calibration body; empty: there is none");
  a.Number("x_m", x_m, {"m", -10, 10, "its origin in the base frame of the robot at its start"});
  a.Number("y_m", y_m, {"m", -10, 10, "its origin in the base frame of the robot at its start"});
  a.Number("z_m", z_m, {"m", 0, 5, "its origin in the base frame of the robot at its start"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "its x axis in the base frame; 180 faces the robot"});
  a.Number("error_m", error_m, {"m", 0, 0.1, "standard deviation of each coordinate"});
  a.Number("error_deg", error_deg, {"deg", 0, 10, "standard deviation of the turn about each axis"});
}

PlacedReference PlaceReference(const ReferencePlan& plan, const ReferenceObject& object,
                               const Pose2& map_from_base, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "reference");
  const auto turn = [&](const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(Radians(rng.Normal(plan.error_deg)), axis);
  };
  Eigen::Isometry3d base_from_object = Eigen::Isometry3d::Identity();
  base_from_object.translate(Eigen::Vector3d(plan.x_m, plan.y_m, plan.z_m));
  base_from_object.rotate(Eigen::AngleAxisd(Radians(plan.yaw_deg), Eigen::Vector3d::UnitZ()));
  for (int i = 0; i < 3; ++i) base_from_object.translate(rng.Normal(plan.error_m) * Eigen::Vector3d::Unit(i));
  for (int i = 0; i < 3; ++i) base_from_object.rotate(turn(Eigen::Vector3d::Unit(i)));
  return {object, Lift(map_from_base) * base_from_object};
}

void WorldPlan::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("map", map, "ground plan with walls and doors, which the planner knows too");
  a.Choice("wall_material", wall_material, MaterialNames(), "how walls look and echo");
  a.Number("brightness_spread", brightness_spread, {"-", 0, 0.9, "brightness is off by up to this part"});
  a.Number("window_spread_deg", window_spread_deg, {"deg", 0, 180, "window_yaw_deg is off by up to this"});
  a.Number("camera_light", camera_light,
           {"-", 0, 4, "lamps beside the lenses, 1 makes reference discs white"});
  a.List("surfaces", surfaces, "walls of another material");
  a.Section("skirting", skirting, "boards along the foot of every wall");
  a.Section("survey", survey, "how wrong the map is, drawn from the seed");
  a.List("doors", doors, "leaf and true dimensions of the map's doors; a door not listed has no leaf");
  a.List("posters", posters, "flat things on walls");
  a.List("boxes", boxes, "furniture, columns, clutter");
  a.List("strewn", strewn, "things drawn from the seed: how many, which and where");
  a.List("free_lanes", free_lanes, "floor on which nothing is strewn");
  a.Section("light", light, "room and light");
  a.Section("start", start, "where the robot starts");
  a.Section("reference", reference, "the calibration body");
  a.Section("grid", grid, "walls from a map of ROS' map_server, beside those of the ground plan");
  a.List("people", people, "who walks and stands there");
  a.List("holes", holes, "pits, and edges where the floor is lower");
  a.Section("cameras", cameras, "how the cameras differ from each other and from what was calibrated");
  a.Section("mast", mast, "how the mast below the head nods");
  a.Section("faults", faults, "what breaks");
}

SceneConfig DrawLight(const WorldPlan& plan, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "light");
  SceneConfig light = plan.light;
  light.brightness *= 1 + rng.Uniform(-plan.brightness_spread, plan.brightness_spread);
  light.window_yaw_deg += rng.Uniform(-plan.window_spread_deg, plan.window_spread_deg);
  light.holes = plan.holes;
  return light;
}

}  // namespace priamos::world
