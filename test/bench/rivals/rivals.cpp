#include "test/bench/rivals/rivals.hpp"

#include <cmath>

#include "test/bench/rivals/dynamic_window.hpp"
#include "test/bench/rivals/own_driver.hpp"
#include "test/bench/rivals/rival_driver.hpp"
#ifdef PRIAMOS_HAS_MRPT_NAV
#include "test/bench/rivals/mrpt_methods.hpp"
#endif

namespace priamos::bench {
namespace {

/// The circle around the base, and the one in it, which is as wide as the base and needs the heading held
/// along the way.
const double kAround_m = std::hypot(kDrawnBody.length_m, kDrawnBody.width_m) / 2;
constexpr double kWithin_m = kDrawnBody.width_m / 2;

using MakeMethod = std::function<std::unique_ptr<Method>()>;

DriverKind Rival(const std::string& name, const MakeMethod& method) {
  return {name, [method](const Order& order) {
            return std::make_unique<RivalDriver>(order, RivalConfig{}, method());
          }};
}

MakeMethod Window(double radius_m) {
  return [radius_m] {
    DynamicWindowConfig config;
    config.radius_m = radius_m;
    return std::make_unique<DynamicWindow>(config);
  };
}

#ifdef PRIAMOS_HAS_MRPT_NAV
MakeMethod Mrpt(std::unique_ptr<Method> (*make)(const MrptConfig&), double radius_m) {
  return [make, radius_m] {
    MrptConfig config;
    config.radius_m = radius_m;
    return make(config);
  };
}
#endif

}  // namespace

std::vector<DriverKind> AllDrivers(const std::string& deployment) {
  std::vector<DriverKind> kinds;
  kinds.push_back({"robot", [deployment](const Order& order) { return OwnDriver(order, deployment); }});
#ifdef PRIAMOS_HAS_MRPT_NAV
  kinds.push_back(Rival("ND, around", Mrpt(MrptNearness, kAround_m)));
  kinds.push_back(Rival("ND, within", Mrpt(MrptNearness, kWithin_m)));
  kinds.push_back(Rival("FullEval, around", Mrpt(MrptFullEval, kAround_m)));
  kinds.push_back(Rival("FullEval, within", Mrpt(MrptFullEval, kWithin_m)));
#endif
  kinds.push_back(Rival("window, around", Window(kAround_m)));
  kinds.push_back(Rival("window, within", Window(kWithin_m)));
  kinds.push_back(Rival("window, rectangle", Window(0)));
  return kinds;
}

}  // namespace priamos::bench
