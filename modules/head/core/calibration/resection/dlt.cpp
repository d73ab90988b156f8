#include "head/core/calibration/resection/dlt.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "head/core/calibration/resection/view_fit.hpp"

namespace priamos::head {

namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

constexpr std::size_t kFewestPoints = 6;
// A body flatter than this share of its extent gives no usable depth.
constexpr double kFlattest = 2e-3;
// Smallest gap to a second solution, relative to the largest singular value.
constexpr double kAmbiguous = 1e-7;

/// x -> scale * (x - mean), so that the mean distance from the origin is sqrt(dimension).
template <int N>
struct Normalisation {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  double scale = 1e300;  ///< this value stands for points that coincide

  Eigen::Matrix<double, N, 1> operator()(const Eigen::Matrix<double, N, 1>& x) const {
    return scale * (x - mean);
  }
  Eigen::Matrix<double, N + 1, N + 1> Homogeneous() const {
    Eigen::Matrix<double, N + 1, N + 1> m = Eigen::Matrix<double, N + 1, N + 1>::Identity();
    m.template topLeftCorner<N, N>() *= scale;
    m.template topRightCorner<N, 1>() = -scale * mean;
    return m;
  }
};

template <int N, class Get>
Normalisation<N> Normalise(std::span<const PointPair> pairs, const Get& get) {
  Normalisation<N> n;
  for (const PointPair& p : pairs) n.mean += get(p);
  n.mean /= pairs.size();
  double distance = 0;
  for (const PointPair& p : pairs) distance += (get(p) - n.mean).norm();
  if (distance > 0) n.scale = std::sqrt(double{N}) * pairs.size() / distance;
  return n;
}

std::optional<Refusal> CheckInput(std::span<const PointPair> pairs) {
  if (pairs.size() < kFewestPoints) {
    return Refusal{fmt::format("a DLT matrix needs at least {} points, got {}", kFewestPoints, pairs.size())};
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].point_m.allFinite() || !pairs[i].image_px.allFinite()) {
      return Refusal{fmt::format("point {} is not a finite number", i)};
    }
  }
  return std::nullopt;
}

std::optional<Refusal> CheckBody(std::span<const PointPair> pairs, const Normalisation<3>& n) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PointPair& p : pairs) {
    const Eigen::Vector3d x = n(p.point_m);
    scatter += x * x.transpose();
  }
  const Eigen::Vector3d extent =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  // The extent relative to where the body stands; rounding alone gives about 1e-16.
  if (!(1 / n.scale > 1e-9 * n.mean.norm()) || !(extent(2) > 0)) return Refusal{"all points coincide"};
  if (extent(1) <= kFlattest * kFlattest * extent(2)) return Refusal{"all points lie on one line"};
  if (extent(0) <= kFlattest * kFlattest * extent(2)) {
    return Refusal{"all points lie in one plane: a single view of it does not determine a DLT matrix"};
  }
  return std::nullopt;
}

Matrix12 NormalMatrix(std::span<const PointPair> pairs, const Normalisation<3>& ns,
                      const Normalisation<2>& ni) {
  // A^T A of equations 5 and 6 times their denominators, rows (X 0 -uX) and (0 X -vX): from three sums of
  // X X^T, weighted with 1, u, v and u^2 + v^2.
  Eigen::Matrix4d one = Eigen::Matrix4d::Zero(), u = one, v = one, square = one;
  for (const PointPair& p : pairs) {
    const Eigen::Vector4d x = ns(p.point_m).homogeneous();
    const Eigen::Vector2d i = ni(p.image_px);
    const Eigen::Matrix4d xx = x * x.transpose();
    one += xx;
    u += i.x() * xx;
    v += i.y() * xx;
    square += i.squaredNorm() * xx;
  }
  Matrix12 m = Matrix12::Zero();
  m.block<4, 4>(0, 0) = one;
  m.block<4, 4>(4, 4) = one;
  m.block<4, 4>(8, 8) = square;
  m.block<4, 4>(8, 0) = -u;
  m.block<4, 4>(8, 4) = -v;
  m.block<4, 4>(0, 8) = -u;
  m.block<4, 4>(4, 8) = -v;
  return m;
}

/// Scales the matrix to depths in metres; returns what is wrong with the geometry if anything is.
std::optional<Refusal> NormaliseDepth(std::span<const PointPair> pairs, Matrix34& m) {
  const double length = m.block<1, 3>(2, 0).norm();
  if (!(length > 0) || !std::isfinite(length)) return Refusal{"the solution is a camera at infinity"};
  m /= length;
  std::size_t behind = 0;
  for (const PointPair& p : pairs) behind += m.row(2).dot(p.point_m.homogeneous()) <= 0;
  if (behind > pairs.size() / 2) {
    m = -m;
    behind = pairs.size() - behind;
  }
  if (behind > 0) {
    return Refusal{
        fmt::format("{} of {} points would lie behind the camera: points and images do not belong together",
                    behind, pairs.size())};
  }
  if (m.leftCols<3>().determinant() < 0) {
    return Refusal{"the image is mirrored: two columns are swapped (u with v, or two of X, Y, Z)"};
  }
  return std::nullopt;
}

}  // namespace

Outcome<Matrix34> SolveDlt(std::span<const PointPair> pairs) {
  if (const auto refusal = CheckInput(pairs)) return *refusal;
  const auto ns = Normalise<3>(
      pairs, [](const PointPair& p) -> const auto& { return p.point_m; });
  const auto ni = Normalise<2>(
      pairs, [](const PointPair& p) -> const auto& { return p.image_px; });
  if (const auto refusal = CheckBody(pairs, ns)) return *refusal;
  const Eigen::SelfAdjointEigenSolver<Matrix12> solver(NormalMatrix(pairs, ns, ni));
  const auto& values = solver.eigenvalues();
  if (values(1) <= kAmbiguous * kAmbiguous * values(11)) {
    return Refusal{"the points are in a degenerate position: more than one DLT matrix fits them"};
  }
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> normalised(solver.eigenvectors().col(0).data());
  Matrix34 m = ni.Homogeneous().inverse() * normalised * ns.Homogeneous();
  const auto refusal = NormaliseDepth(pairs, m);
  if (!refusal) return m;
  // Few noisy points with weak perspective leave even the sign of the depths open. If a camera with square
  // pixels explains them, that is the answer; if the columns are swapped, none does.
  const Outcome<PinholeView> view = FitViewFromPoints(pairs);
  if (!view) return *refusal;
  return view->Model().image_from_base;
}

double MeanImageError(const Matrix34& image_from_base, std::span<const PointPair> pairs) {
  double sum = 0;
  for (const PointPair& p : pairs) {
    sum += ((image_from_base * p.point_m.homogeneous()).hnormalized() - p.image_px).norm();
  }
  return pairs.empty() ? 0 : sum / pairs.size();
}

}  // namespace priamos::head
