#include "head/core/doors/door_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace priamos::head {
namespace {

using Unknowns = Eigen::Matrix<double, 5, 1>;  ///< left x, y, right x, y, height

constexpr int kRounds = 4;
constexpr double kDerivativeStep_m = 1e-4;  ///< for derivatives
constexpr double kFar_m = 0.4;              ///< farther from the start it is something else

/// A point of the door that should lie on an image line.
struct Observation {
  const CameraView* view;
  const ViewLine* line;
  Eigen::Index side;  ///< 0 left, 1 right
  bool is_corner;     ///< the lintel's end; else a point of the upright at height z
  double z = 0;
  double sigma_px = 1;

  double Residual(const Unknowns& x) const {
    const Eigen::Vector3d at(x[2 * side], x[2 * side + 1], is_corner ? x[4] : z);
    return line->normal.dot(view->camera->Project(at) - line->p) / sigma_px;
  }
};

/// Height at which an image row is seen on the vertical through `at`.
double HeightAt(const CameraModel& camera, const Eigen::Vector2d& at, double v) {
  const Eigen::RowVector4d row = camera.image_from_base.row(1) - v * camera.image_from_base.row(2);
  return -(row.x() * at.x() + row.y() * at.y() + row.w()) / row.z();
}

double SigmaOf(const CameraView& view, const ViewLine& line, const Eigen::Vector2d& at, double extra) {
  const EdgeSegment& segment = view.edges->segments[line.segment];
  const Eigen::Vector2d direction = (line.q - line.p) / line.length_px;
  const double along = direction.dot(at - (line.p + line.q) / 2);
  return std::hypot(segment.SigmaAt(along), extra);
}

std::vector<Observation> Observe(const std::array<const CameraView*, 2>& views, const DoorLines& lines,
                                 const DoorShape& start, double sigma_px) {
  std::vector<Observation> all;
  const std::array<const Eigen::Vector2d*, 2> at{&start.left, &start.right};
  for (int c = 0; c < 2; ++c) {
    const CameraView& view = *views[c];
    for (int side = 0; side < 2; ++side) {
      if (const int i = lines.uprights[c][side]; i >= 0) {
        const ViewLine& line = view.lines[i];
        const Eigen::Vector2d middle = (line.p + line.q) / 2;
        all.push_back({&view, &line, side, false, HeightAt(*view.camera, *at[side], middle.y()),
                       SigmaOf(view, line, middle, sigma_px)});
      }
      if (const int i = lines.lintel[c]; i >= 0) {
        const ViewLine& line = view.lines[i];
        const Eigen::Vector2d corner = view.camera->Project({at[side]->x(), at[side]->y(), start.height_m});
        all.push_back({&view, &line, side, true, 0, SigmaOf(view, line, corner, sigma_px)});
      }
    }
  }
  return all;
}

}  // namespace

std::optional<DoorFit> FitDoor(const std::array<const CameraView*, 2>& views, const DoorLines& lines,
                               const DoorShape& start, double sigma_px) {
  const auto observations = Observe(views, lines, start, sigma_px);
  const int n = static_cast<int>(observations.size());
  if (n < 5) return std::nullopt;
  Unknowns x;
  x << start.left, start.right, start.height_m;
  const Unknowns first = x;
  Eigen::VectorXd r(n);
  Eigen::Matrix<double, Eigen::Dynamic, 5> j(n, 5);
  Eigen::LDLT<Eigen::Matrix<double, 5, 5>> solver;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < n; ++i) {
      r[i] = observations[i].Residual(x);
      for (int k = 0; k < 5; ++k) {
        Unknowns moved = x;
        moved[k] += kDerivativeStep_m;
        j(i, k) = (observations[i].Residual(moved) - r[i]) / kDerivativeStep_m;
      }
    }
    const Eigen::Matrix<double, 5, 5> information = j.transpose() * j;
    solver.compute(information);
    if (solver.info() != Eigen::Success || solver.rcond() < 1e-9) return std::nullopt;
    const Unknowns right = j.transpose() * r;
    x -= solver.solve(right);
    if (!x.allFinite() || (x - first).head<4>().cwiseAbs().maxCoeff() > kFar_m) return std::nullopt;
  }
  DoorFit fit;
  fit.shape = {x.head<2>(), x.segment<2>(2), x[4]};
  fit.covariance = solver.solve(Eigen::Matrix<double, 5, 5>::Identity());
  for (const Observation& o : observations) fit.chi2 += std::pow(o.Residual(x), 2);
  fit.freedom = n - 5;
  return fit;
}

}  // namespace priamos::head
