#include "cli/lockstep/factories.hpp"

#include <stdexcept>
#include <type_traits>

#include "bus/parameters/parameter_messages.hpp"
#include "bus/process_config.hpp"
#include "console/console_app.hpp"
#include "head/head_app.hpp"
#include "planner/planner_app.hpp"
#include "radio/radio_app.hpp"
#include "robot/robot_app.hpp"
#include "teleop/teleop_app.hpp"
#include "world/world_app.hpp"

namespace priamos::cli {

namespace {

/// The result of `visit` for the App of `module`.
template <class Visit>
auto WithApp(const std::string& module, Visit visit) {
  if (module == "world") return visit(std::type_identity<world::WorldApp>());
  if (module == "robot") return visit(std::type_identity<robot::RobotApp>());
  if (module == "head") return visit(std::type_identity<head::HeadApp>());
  if (module == "planner") return visit(std::type_identity<planner::PlannerApp>());
  if (module == "teleop") return visit(std::type_identity<teleop::TeleopApp>());
  if (module == "console") return visit(std::type_identity<console::ConsoleApp>());
  if (module == "radio") return visit(std::type_identity<radio::RadioApp>());
  throw std::invalid_argument("no module named " + module);
}

/// What the configuration of every process may have beside the keys of its App.
struct BusSection {
  bus::BusChoice choice;
  void Describe(Archive& a) { bus::DescribeBus(a, choice); }
};

}  // namespace

bus::AppFactory FactoryFor(const std::string& module) {
  return WithApp(module, []<class T>(std::type_identity<T>) { return bus::FactoryOf<T>(); });
}

std::vector<ConfigKey> ConfigKeysOf(const std::string& module) {
  auto keys = WithApp(module, []<class T>(std::type_identity<T>) { return KeysOf<typename T::Config>(); });
  auto of_bus = KeysOf<BusSection>();
  for (ConfigKey& key : of_bus)
    if (key.name == "bus.name") key.value = '"' + FactoryFor(module).default_bus + '"';
  keys.insert(keys.end(), of_bus.begin(), of_bus.end());
  return keys;
}

std::vector<std::string> ModulesWithParameters() {
  std::vector<std::string> modules;
  for (int process = 1; !bus::ProcessOfParameters(process).empty(); ++process)
    modules.emplace_back(bus::ProcessOfParameters(process));
  return modules;
}

std::shared_ptr<void> HoldShared() {
  return world::HoldGraphics();
}

}  // namespace priamos::cli
