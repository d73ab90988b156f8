#include "world/core/scene/built_doors.hpp"

#include <algorithm>

#include "common/random.hpp"

namespace priamos::world {
namespace {

/// Thinner parts of a frame are not built.
constexpr double kLeast_m = 0.003;

/// What a tape says is off by so much.
double TapeError(double sigma_m, Rng& rng) {
  return std::clamp(rng.Normal(sigma_m), -3 * sigma_m, 3 * sigma_m);
}

DoorWork WorkOf(const DoorPlan& door, const WorldPlan& plan) {
  for (const DoorWork& work : plan.doors)
    if (work.id == door.id) return work;
  return {};
}

/// Adds the errors of the survey to what the world says of the door.
void AddErrors(const SurveyPlan& survey, Rng& rng, DoorWork& work) {
  const auto within = [&](double bound) { return rng.Uniform(-1, 1) * bound; };
  work.built_dx_m += within(survey.place_m);
  work.built_dy_m += within(survey.place_m);
  work.built_dyaw_deg += within(survey.yaw_deg);
  work.built_dwidth_m += TapeError(survey.size_sigma_m, rng) - rng.Uniform(0, 1) * survey.narrower_m;
  for (double* size :
       {&work.built_dheight_m, &work.built_dframe_m, &work.built_dprotrusion_m, &work.built_dthickness_m})
    *size += TapeError(survey.size_sigma_m, rng);
}

}  // namespace

DoorPlan AsBuilt(DoorPlan door, const DoorWork& work) {
  const Pose2 built =
      door.map_from_door() * Pose2{work.built_dx_m, work.built_dy_m, Radians(work.built_dyaw_deg)};
  door.x_m = built.x;
  door.y_m = built.y;
  door.yaw_deg = Degrees(built.yaw);
  door.opening_width_m += work.built_dwidth_m;
  door.opening_height_m += work.built_dheight_m;
  door.frame_width_m += work.built_dframe_m;
  door.frame_protrusion_m += work.built_dprotrusion_m;
  door.wall_thickness_m += work.built_dthickness_m;
  return door;
}

std::vector<DoorPlan> BuiltDoors(const GroundPlan& map, const WorldPlan& plan, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "survey");
  std::vector<DoorPlan> doors;
  for (const DoorPlan& door : map.doors) {
    DoorWork work = WorkOf(door, plan);
    AddErrors(plan.survey, rng, work);
    doors.push_back(AsBuilt(door, work));
    DoorPlan& built = doors.back();
    built.frame_width_m = std::max(built.frame_width_m, kLeast_m);
    built.frame_protrusion_m =
        std::max(built.frame_protrusion_m, std::min(kLeast_m, door.frame_protrusion_m));
  }
  return doors;
}

}  // namespace priamos::world
