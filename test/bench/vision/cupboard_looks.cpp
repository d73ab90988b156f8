#include "test/bench/vision/cupboard_looks.hpp"

#include <cmath>

#include "common/config.hpp"
#include "planner/core/map/cupboard_landmark.hpp"

namespace priamos::bench {
namespace {

constexpr double kDistance_m = 2.0;  // of the head
constexpr double kWall_m = 4.8;      // the north wall, map
// Shares of height and of width, measured in the picture of the front.
constexpr double kPlinthShare = 0.05, kGrooveShare = 6.5 / 512;

CupboardPlan DrawCupboard(Rng& rng) {
  CupboardPlan cupboard;
  cupboard.width_m = rng.Uniform(0.8, 1.2);
  cupboard.depth_m = rng.Uniform(0.35, 0.5);
  cupboard.height_m = rng.Uniform(1.6, 2.0);
  cupboard.plinth_m = kPlinthShare * cupboard.height_m;
  cupboard.gap_m = kGrooveShare * cupboard.width_m;
  cupboard.x_m = rng.Uniform(2.0, 4.0);
  cupboard.y_m = kWall_m - 0.03 - cupboard.depth_m;
  cupboard.yaw_deg = 90;
  return cupboard;
}

world::BoxPlan BoxOf(const CupboardPlan& cupboard, const char* material) {
  world::BoxPlan box;
  box.name = "cupboard " + std::to_string(cupboard.id);
  box.x_m = cupboard.x_m;
  box.y_m = cupboard.y_m + cupboard.depth_m / 2;
  box.length_m = cupboard.width_m;
  box.width_m = cupboard.depth_m;
  box.height_m = cupboard.height_m;
  box.material = material;
  return box;
}

/// Another cupboard to the left or to the right, touching or not.
world::BoxPlan Neighbour(const CupboardPlan& cupboard, Rng& rng) {
  CupboardPlan other = DrawCupboard(rng);
  other.id = cupboard.id + 1;
  const double apart = (cupboard.width_m + other.width_m) / 2 + rng.Uniform(0, 0.4);
  other.x_m = cupboard.x_m + (rng.Chance(0.5) ? apart : -apart);
  return BoxOf(other, rng.Chance(0.5) ? "cupboard" : "furniture");
}

/// Narrower or wider by 6 to 15 cm: not the one that is looked for.
void Replace(CupboardPlan& cupboard, Rng& rng) {
  cupboard.width_m += (rng.Chance(0.5) ? 1 : -1) * rng.Uniform(0.06, 0.15);
  cupboard.height_m += rng.Uniform(-0.15, 0.15);
  cupboard.x_m += rng.Uniform(-0.2, 0.2);
}

/// A carton on a table's height or more before one half of it.
world::BoxPlan InTheWay(const CupboardPlan& cupboard, Rng& rng) {
  world::BoxPlan box;
  box.name = "in the way";
  box.x_m = cupboard.x_m + (rng.Chance(0.5) ? 1 : -1) * rng.Uniform(0.25, 0.6);
  box.y_m = cupboard.y_m - rng.Uniform(0.3, 1.0);
  box.length_m = rng.Uniform(0.4, 0.9);
  box.width_m = rng.Uniform(0.2, 0.5);
  box.height_m = rng.Uniform(1.4, 2.1);
  box.yaw_deg = rng.Uniform(-20, 20);
  box.material = rng.Chance(0.5) ? "furniture" : "cardboard";
  return box;
}

void AddPoster(LookStage& stage, Rng& rng) {
  world::PosterPlan& poster = stage.plan.posters.emplace_back();
  poster.wall = "north";
  poster.face = "right";
  poster.along_m = rng.Uniform(1, 5.5);
  poster.bottom_m = rng.Uniform(0.9, 1.6);
  poster.width_m = rng.Uniform(0.2, 0.9);
  poster.height_m = rng.Uniform(0.3, 0.9);
}

LookStage MakeStage(std::uint64_t seed, CupboardTrouble trouble) {
  Rng rng = Rng::Stream(seed, "cupboard"), trouble_rng = Rng::Stream(seed, "cupboard trouble");
  LookStage stage{LoadConfig<world::WorldPlan>(InSim("worlds/door.toml")), {}, {}, {}, kDistance_m};
  stage.map = LoadConfig<GroundPlan>(InSim(stage.plan.map));
  stage.plan.boxes.clear();
  stage.light = world::DrawLight(stage.plan, seed);
  CupboardPlan cupboard = DrawCupboard(rng);
  stage.landmark = planner::MakeCupboardLandmark(cupboard);
  if (rng.Chance(0.5)) stage.plan.boxes.push_back(Neighbour(cupboard, rng));
  AddPoster(stage, rng);
  if (trouble == CupboardTrouble::kAnother) Replace(cupboard, trouble_rng);
  if (trouble != CupboardTrouble::kAbsent) stage.plan.boxes.push_back(BoxOf(cupboard, "cupboard"));
  if (trouble == CupboardTrouble::kHalfHidden) stage.plan.boxes.push_back(InTheWay(cupboard, trouble_rng));
  if (trouble == CupboardTrouble::kOtherLight) stage.ChangeLight();
  if (trouble == CupboardTrouble::kLightsOut)
    stage.light.brightness *= std::exp(trouble_rng.Uniform(std::log(0.01), std::log(0.2)));
  return stage;
}

}  // namespace

const char* Describe(CupboardTrouble trouble) {
  constexpr const char* kWords[] = {"nothing",     "cupboard absent", "another cupboard",
                                    "half hidden", "lights out",      "other light"};
  return kWords[static_cast<int>(trouble)];
}

CupboardPhotographer::CupboardPhotographer() : graphics_(world::Renderer::HoldGraphics()) {}

LandmarkLook CupboardPhotographer::Take(std::uint64_t seed, CupboardTrouble trouble,
                                        const CalibratedHead& head, int visit) {
  LookStage stage = MakeStage(seed, trouble);
  stage.visit = visit;
  LandmarkLook look = TakeLook(stage, head, {}, 0, seed);
  look.is_there = trouble != CupboardTrouble::kAbsent && trouble != CupboardTrouble::kAnother;
  return look;
}

}  // namespace priamos::bench
