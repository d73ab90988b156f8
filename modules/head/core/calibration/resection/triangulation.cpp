#include "head/core/calibration/resection/triangulation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <vector>

namespace priamos::head {

namespace {

constexpr int kSteps = 4;
constexpr double kSmallestAngle_rad = 1e-4;  // of intersection, about

}  // namespace

std::optional<Eigen::Vector3d> Triangulate(std::span<const Ray> rays) {
  if (rays.size() < 2) return std::nullopt;
  std::vector<double> weights(rays.size(), 1.0);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& p = rays[i].camera->image_from_base;
      const Eigen::Vector2d px = rays[i].camera->Undistort(rays[i].image_px);
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::RowVector4d row = weights[i] * (px[axis] * p.row(2) - p.row(axis));
        normal += row.head<3>().transpose() * row.head<3>();
        rhs -= row.head<3>().transpose() * row(3);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
    const double flattest = kSmallestAngle_rad * kSmallestAngle_rad * solver.eigenvalues()(2);
    if (!(solver.eigenvalues()(0) > flattest)) return std::nullopt;
    point = normal.ldlt().solve(rhs);
    // An algebraic error divided by the depth is the error in the image.
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double depth = rays[i].camera->Depth(point);
      if (!(depth > 0)) return std::nullopt;
      weights[i] = 1 / depth;
    }
  }
  return point;
}

}  // namespace priamos::head
