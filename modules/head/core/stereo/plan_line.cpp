#include "head/core/stereo/plan_line.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace priamos::head {

bool IsLevel(const ViewLine& line) {
  constexpr double kUpright = 0.05;  // |z| of the unit normal of its plane of sight
  return std::abs(line.plane.z()) > kUpright;
}

PlanLine::PlanLine(const ViewLine& line, double z) {
  const double scale = line.plane.head<2>().norm();
  normal = line.plane.head<2>() / scale;
  offset = (line.plane.z() * z + line.plane.w()) / scale;
}

std::optional<Eigen::Vector2d> Crossing(const PlanLine& a, const PlanLine& b) {
  constexpr double kParallel = 0.02;
  Eigen::Matrix2d m;
  m << a.normal.transpose(), b.normal.transpose();
  if (std::abs(m.determinant()) < kParallel) return std::nullopt;
  return m.inverse() * Eigen::Vector2d(-a.offset, -b.offset);
}

}  // namespace priamos::head
