#include "head/core/scene/upright_edges.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace priamos::head {
namespace {

constexpr double kLeastVariance_m2 = 1e-7;  ///< keeps the covariances of exact edges invertible
constexpr double kSigmas = 3;

/// The place of an edge as that of a vertical one: both ends weighed by their common covariance, or nothing
/// when they are too far apart for a vertical edge.
std::optional<UprightEdge> AsUpright(const SpaceEdge& edge, const UprightOptions& options) {
  const double height = std::abs(edge.to.z() - edge.from.z());
  if (height < options.min_height_m) return std::nullopt;
  Eigen::Matrix4d covariance;
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j)
      covariance.block<2, 2>(2 * i, 2 * j) = edge.covariance.block<2, 2>(3 * i, 3 * j);
  covariance.diagonal().array() += kLeastVariance_m2;
  Eigen::Matrix<double, 2, 4> difference;
  difference << Eigen::Matrix2d::Identity(), -Eigen::Matrix2d::Identity();
  const Eigen::Vector2d lean = edge.from.head<2>() - edge.to.head<2>();
  const Eigen::Matrix2d spread = difference * covariance * difference.transpose();
  const double allowed = options.lean * height;
  const Eigen::Matrix2d bound = kSigmas * kSigmas * spread + allowed * allowed * Eigen::Matrix2d::Identity();
  if (lean.dot(bound.inverse() * lean) > 1) return std::nullopt;
  Eigen::Matrix<double, 4, 2> both;
  both << Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity();
  const Eigen::Matrix4d information = covariance.inverse();
  UprightEdge upright;
  upright.covariance = (both.transpose() * information * both).inverse();
  Eigen::Vector4d ends;
  ends << edge.from.head<2>(), edge.to.head<2>();
  upright.at = upright.covariance * both.transpose() * information * ends;
  upright.bottom_m = std::min(edge.from.z(), edge.to.z());
  upright.top_m = std::max(edge.from.z(), edge.to.z());
  return upright;
}

}  // namespace

bool AreOne(const UprightEdge& a, const UprightEdge& b, const UprightOptions& options) {
  if (std::max(a.bottom_m, b.bottom_m) - std::min(a.top_m, b.top_m) > options.gap_m) return false;
  const Eigen::Matrix2d bound = kSigmas * kSigmas * (a.covariance + b.covariance) +
                                options.same_m * options.same_m * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d off = a.at - b.at;
  return off.dot(bound.inverse() * off) < 1;
}

namespace {

/// Most of their errors is that of the calibration, which both share: together they are no surer than the
/// better one.
void Join(const UprightEdge& piece, UprightEdge& edge) {
  const Eigen::Matrix2d gain = edge.covariance * (edge.covariance + piece.covariance).inverse();
  edge.at += gain * (piece.at - edge.at);
  if (piece.covariance.trace() < edge.covariance.trace()) edge.covariance = piece.covariance;
  edge.bottom_m = std::min(edge.bottom_m, piece.bottom_m);
  edge.top_m = std::max(edge.top_m, piece.top_m);
}

}  // namespace

std::vector<UprightEdge> FindUprights(std::span<const StereoMatch> matches, const UprightOptions& options) {
  std::vector<UprightEdge> pieces;
  for (const StereoMatch& match : matches) {
    if (!match.space) continue;
    auto upright = AsUpright(*match.space, options);
    if (!upright || std::sqrt(upright->covariance.trace()) > options.max_sigma_m ||
        upright->at.norm() > options.max_distance_m)
      continue;
    pieces.push_back(*std::move(upright));
  }
  // The longest first: they say best where the others belong.
  std::stable_sort(pieces.begin(), pieces.end(), [](const UprightEdge& a, const UprightEdge& b) {
    return a.top_m - a.bottom_m > b.top_m - b.bottom_m;
  });
  std::vector<UprightEdge> edges;
  for (const UprightEdge& piece : pieces) {
    const auto same = std::find_if(edges.begin(), edges.end(),
                                   [&](const UprightEdge& edge) { return AreOne(piece, edge, options); });
    if (same == edges.end())
      edges.push_back(piece);
    else
      Join(piece, *same);
  }
  return edges;
}

}  // namespace priamos::head
