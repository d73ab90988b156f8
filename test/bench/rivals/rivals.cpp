#include "test/bench/rivals/rivals.hpp"

#include "common/config.hpp"
#include "test/bench/rivals/own_driver.hpp"
#include "test/bench/rivals/rival_tuning.hpp"

namespace priamos::bench {
namespace {

/// Nothing where that method is not there.
std::unique_ptr<Method> MethodOf(const RivalTuning& tuning) {
  if (tuning.method == "window") {
    DynamicWindowConfig config = tuning.window;
    config.radius_m = tuning.Radius();
    return std::make_unique<DynamicWindow>(config);
  }
#ifdef PRIAMOS_HAS_MRPT_NAV
  MrptConfig config = tuning.mrpt;
  config.radius_m = tuning.Radius();
  return tuning.method == "nd" ? MrptNearness(config) : MrptFullEval(config);
#else
  return nullptr;
#endif
}

}  // namespace

std::vector<DriverKind> AllDrivers(const std::string& deployment, const std::string& tuning) {
  std::vector<DriverKind> kinds;
  for (const bool replans : {false, true})
    kinds.push_back({replans ? "robot, planner" : "robot", [deployment, replans](const Order& order) {
                       return OwnDriver(order, deployment, replans);
                     }});
  for (const RivalTuning& rival : LoadConfig<Tuning>(tuning).rivals)
    if (MethodOf(rival))
      kinds.push_back({rival.name, [rival](const Order& order) {
                         return std::make_unique<RivalDriver>(order, rival.drive, MethodOf(rival));
                       }});
  return kinds;
}

}  // namespace priamos::bench
