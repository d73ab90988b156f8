#include "cli/factories.hpp"

#include <stdexcept>

#include "head/head_app.hpp"
#include "planner/planner_app.hpp"
#include "radio/radio_app.hpp"
#include "robot/robot_app.hpp"
#include "teleop/teleop_app.hpp"
#include "world/world_app.hpp"

namespace priamos::cli {

bus::AppFactory FactoryFor(const std::string& module) {
  if (module == "world") return bus::FactoryOf<world::WorldApp>();
  if (module == "robot") return bus::FactoryOf<robot::RobotApp>();
  if (module == "head") return bus::FactoryOf<head::HeadApp>();
  if (module == "planner") return bus::FactoryOf<planner::PlannerApp>();
  if (module == "teleop") return bus::FactoryOf<teleop::TeleopApp>();
  if (module == "radio") return bus::FactoryOf<radio::RadioApp>();
  throw std::invalid_argument("no module named " + module);
}

std::shared_ptr<void> HoldShared() {
  return world::HoldGraphics();
}

}  // namespace priamos::cli
