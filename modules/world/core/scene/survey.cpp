#include "world/core/scene/survey.hpp"

namespace priamos::world {

void SurveyPlan::Describe(Archive& a) {
  a.Number("place_m", place_m, {"m", 0, 0.5, "a door and its wall are off by up to this along each axis"});
  a.Number("yaw_deg", yaw_deg, {"deg", 0, 20, "they are turned by up to this"});
  a.Number("size_sigma_m", size_sigma_m, {"m", 0, 0.03, "sigma of each dimension of a door"});
  a.Number("narrower_m", narrower_m, {"m", 0, 0.2, "its opening is narrower by up to this, in addition"});
}

}  // namespace priamos::world
