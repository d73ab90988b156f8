#include "test/bench/rivals/sonar_grids.hpp"

#include <fmt/format.h>

#include "robot/core/sonar/evidence_grid.hpp"

namespace priamos::bench {
namespace {

class OwnGrid : public SonarGrid {
 public:
  void Add(const PlacedEcho& echo, Time now) override { grid_.Add(echo.odom_from_sonar, echo.range_m, now); }
  std::vector<Eigen::Vector2d> Things(const Pose2& odom_from_base, double reach_m, Time now) const override {
    auto things = grid_.Things(odom_from_base, now);
    std::erase_if(things, [&](const Eigen::Vector2d& thing) { return thing.norm() > reach_m; });
    return things;
  }

 private:
  robot::EvidenceGrid grid_{robot::EvidenceGridConfig{}};
};

}  // namespace

std::vector<GridKind> AllGrids() {
  std::vector<GridKind> kinds{{"evidence grid", [] { return std::make_unique<OwnGrid>(); }}};
#ifdef PRIAMOS_HAS_MRPT_NAV
  for (const double aperture_deg : {15.0, 5.0})
    for (const double thing : {0.6, 0.77, 0.9})
      kinds.push_back({fmt::format("MRPT, {:.0f} deg, {:.2f}", aperture_deg, thing),
                       [=] { return MrptGrid(aperture_deg, 0.65, thing); }});
#endif
  return kinds;
}

}  // namespace priamos::bench
