#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservationRange.h>

#include <cmath>

#include "test/bench/rivals/sonar_grids.hpp"

namespace priamos::bench {
namespace {

constexpr float kCell_m = 0.05F, kHalf_m = 20;
/// As the evidence grid: echoes from farther away say nothing.
constexpr double kReach_m = 2.0;

class OccupancyGrid : public SonarGrid {
 public:
  OccupancyGrid(double aperture_deg, double certainty, double thing)
      : grid_(-kHalf_m, kHalf_m, -kHalf_m, kHalf_m, kCell_m), thing_(thing) {
    grid_.insertionOptions.maxOccupancyUpdateCertainty = static_cast<float>(certainty);
    echo_.sensorConeApperture = static_cast<float>(Radians(aperture_deg));
    echo_.maxSensorDistance = 5;
    echo_.sensedData.resize(1);
  }

  void Add(const PlacedEcho& echo, Time) override {
    if (echo.range_m > kReach_m) return;
    const Pose2& at = echo.odom_from_sonar;
    echo_.sensedData[0].sensedDistance = static_cast<float>(echo.range_m);
    grid_.insertObservation(echo_, mrpt::poses::CPose3D(at.x, at.y, 0, at.yaw, 0, 0));
  }
  std::vector<Eigen::Vector2d> Things(const Pose2& odom_from_base, double reach_m, Time) const override {
    const Pose2 base_from_odom = odom_from_base.Inverse();
    std::vector<Eigen::Vector2d> things;
    const int cells = static_cast<int>(reach_m / kCell_m) + 1;
    const int x = grid_.x2idx(odom_from_base.x), y = grid_.y2idx(odom_from_base.y);
    for (int i = x - cells; i <= x + cells; ++i)
      for (int j = y - cells; j <= y + cells; ++j) {
        if (1 - grid_.getCell(i, j) < thing_) continue;
        const Eigen::Vector2d at = base_from_odom * Eigen::Vector2d(grid_.idx2x(i), grid_.idx2y(j));
        if (at.norm() <= reach_m) things.push_back(at);
      }
    return things;
  }

 private:
  mrpt::maps::COccupancyGridMap2D grid_;
  mrpt::obs::CObservationRange echo_;
  double thing_;
};

}  // namespace

std::unique_ptr<SonarGrid> MrptGrid(double aperture_deg, double certainty, double thing) {
  return std::make_unique<OccupancyGrid>(aperture_deg, certainty, thing);
}

}  // namespace priamos::bench
