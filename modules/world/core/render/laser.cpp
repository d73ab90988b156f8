#include "world/core/render/laser.hpp"

namespace priamos::world {

Eigen::Isometry3d LaserBuild::BaseFromFan() const {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return Eigen::Translation3d(x_m, y_m, z_m) * AngleAxisd(yaw_rad, Vector3d::UnitZ()) *
         AngleAxisd(pitch_rad, Vector3d::UnitY()) * AngleAxisd(roll_rad, Vector3d::UnitX());
}

void LaserBuild::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -2, 2, "where the fan begins, base frame"});
  a.Number("y_m", y_m, {"m", -2, 2, "where the fan begins, base frame"});
  a.Number("z_m", z_m, {"m", 0, 3, "where the fan begins, base frame"});
  a.Number("roll_rad", roll_rad, {"rad", -0.5, 0.5, "roll of the fan, right side down"});
  a.Number("pitch_rad", pitch_rad, {"rad", -1.5, 1.5, "pitch of the fan's middle, positive looks down"});
  a.Number("yaw_rad", yaw_rad, {"rad", -3.2, 3.2, "yaw of the fan's middle, positive looks left"});
  a.Number("half_angle_rad", half_angle_rad, {"rad", 0.01, 1.4, "from its middle to its sides"});
  a.Number("thickness_m", thickness_m, {"m", 0.0005, 0.05, "thickness of the sheet of light"});
}

std::vector<LaserBuild> ShippedLasers() {
  LaserBuild near, far;
  far.pitch_rad = 0.232;
  return {near, far};
}

void DescribeLasers(Archive& a, std::vector<LaserBuild>& lasers) {
  a.List("lasers", lasers, "line lasers for obstacles, each with its plane; all shine at once");
  if (lasers.empty() || lasers.size() > kMostLasers)
    a.Refuse("lasers", "1 to 4 line lasers, a table [[lasers]] for each");
}

Eigen::Hyperplane<double, 3> LaserBuild::Plane() const {
  const Eigen::Isometry3d base_from_fan = BaseFromFan();
  return {base_from_fan.linear().col(2), base_from_fan.translation()};
}

}  // namespace priamos::world
