#include "head/core/stand/level_directions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr int kBins = 180;              ///< of a half turn
constexpr int kSpread = 2;              ///< bins beside a peak that belong to it
constexpr int kApart = 20;              ///< least bins between two directions
constexpr double kSecondShare = 0.25;   ///< of the first one's weight that the second one needs
constexpr double kAlongHorizon = 0.15;  ///< sine: a nearly level plane of sight has no direction
constexpr int kFitRounds = 12;
constexpr double kFirstReach = 9, kLastReach = 3;  ///< standard deviations within which an edge agrees

using Unknowns = Eigen::Matrix<double, 4, 1>;  ///< turns of `up` (2), and of each wall about it

/// Axes across `up`.
std::array<Eigen::Vector3d, 2> Across(const Eigen::Vector3d& up) {
  const Eigen::Vector3d first = up.unitOrthogonal();
  return {first, up.cross(first)};
}

/// Weight of edges by their direction across `up`.
std::array<double, kBins> Histogram(std::span<const UprightVote> edges, const Eigen::Vector3d& up) {
  const auto axes = Across(up);
  std::array<double, kBins> bins{};
  for (const UprightVote& edge : edges) {
    const Eigen::Vector3d along = edge.normal.cross(up);
    if (along.norm() < kAlongHorizon) continue;
    const double angle = std::atan2(along.dot(axes[1]), along.dot(axes[0]));
    bins[static_cast<int>(std::floor((angle / kPi + 2) * kBins)) % kBins] += edge.weight;
  }
  return bins;
}

double PeakAt(const std::array<double, kBins>& bins, int at) {
  double sum = 0;
  for (int k = -kSpread; k <= kSpread; ++k) sum += bins[(at + k + kBins) % kBins];
  return sum;
}

int Highest(const std::array<double, kBins>& bins, int away_from) {
  int best = -1;
  double most = 0;
  for (int i = 0; i < kBins; ++i) {
    const int apart = std::abs(i - away_from);
    if (away_from >= 0 && std::min(apart, kBins - apart) < kApart) continue;
    if (const double peak = PeakAt(bins, i); peak > most) most = peak, best = i;
  }
  return best;
}

/// The sums of one round of least squares.
struct Normal {
  Eigen::Matrix4d information = Eigen::Matrix4d::Identity() * 1e-6;
  Unknowns right = Unknowns::Zero();
  double chi2 = 0, weights = 0;

  void Add(const Unknowns& j, double r, double reach) {
    const double share = 1 - r * r / (reach * reach), w = share * share;
    information += w * j * j.transpose();
    right -= w * r * j;
    chi2 += w * r * r;
    weights += w;
  }
};

/// Adds all edges that agree, and counts them.
Normal AddAll(std::span<const UprightVote> steep, std::span<const UprightVote> others, double lean_rad,
              double reach, LevelFrame& frame) {
  Normal normal;
  const auto axes = Across(frame.up);
  frame.n_upright = frame.n_level = 0;
  for (const UprightVote& edge : steep) {
    const double sigma = std::hypot(edge.Sigma(frame.up), lean_rad), r = edge.normal.dot(frame.up) / sigma;
    if (std::abs(r) > reach) continue;
    normal.Add(Unknowns(edge.normal.dot(axes[0]), edge.normal.dot(axes[1]), 0, 0) / sigma, r, reach);
    ++frame.n_upright;
  }
  for (const UprightVote& edge : others) {
    for (std::size_t k = 0; k < frame.walls.size(); ++k) {
      const Eigen::Vector3d& wall = frame.walls[k];
      const double sigma = std::hypot(edge.Sigma(wall), lean_rad), r = edge.normal.dot(wall) / sigma;
      if (std::abs(r) > reach) continue;
      // When `up` turns towards an axis, what is level turns away from it.
      const double along = edge.normal.dot(frame.up);
      Unknowns j(-along * wall.dot(axes[0]), -along * wall.dot(axes[1]), 0, 0);
      j[2 + static_cast<Eigen::Index>(k)] = edge.normal.dot(frame.up.cross(wall));
      normal.Add(j / sigma, r, reach);
      ++frame.n_level;
      break;
    }
  }
  return normal;
}

void Turn(const Unknowns& step, LevelFrame& frame) {
  const auto axes = Across(frame.up);
  const Eigen::Vector3d up = (frame.up + step[0] * axes[0] + step[1] * axes[1]).normalized();
  for (std::size_t k = 0; k < frame.walls.size(); ++k) {
    const Eigen::Vector3d& wall = frame.walls[k];
    const Eigen::Vector3d turned = wall + step[2 + static_cast<Eigen::Index>(k)] * frame.up.cross(wall);
    frame.walls[k] = (turned - up * up.dot(turned)).normalized();
  }
  frame.up = up;
}

}  // namespace

std::vector<Eigen::Vector3d> FindLevelDirections(std::span<const UprightVote> edges,
                                                 const Eigen::Vector3d& up) {
  const auto bins = Histogram(edges, up);
  const auto axes = Across(up);
  std::vector<Eigen::Vector3d> walls;
  const auto add = [&](int bin) {
    const double angle = kPi * (bin + 0.5) / kBins;
    walls.emplace_back(std::cos(angle) * axes[0] + std::sin(angle) * axes[1]);
  };
  const int first = Highest(bins, -1);
  if (first < 0) return walls;
  add(first);
  const int second = Highest(bins, first);
  if (second >= 0 && PeakAt(bins, second) > kSecondShare * PeakAt(bins, first)) add(second);
  return walls;
}

LevelFrame FitLevelFrame(std::span<const UprightVote> steep, std::span<const UprightVote> others,
                         const LevelFrame& start, const UprightOptions& options) {
  LevelFrame frame = start;
  for (int round = 0; round < kFitRounds; ++round) {
    const double part = std::min(1.0, round / (kFitRounds - 4.0));
    const double reach = kFirstReach + part * (kLastReach - kFirstReach);
    const Normal normal = AddAll(steep, others, options.lean_sigma_rad, reach, frame);
    if (frame.n_upright < 2 || frame.n_level < 2) return start;
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal.information);
    const Unknowns step = solver.solve(normal.right);
    if (!step.allFinite() || step.head<2>().norm() > 0.2) return start;
    Turn(step, frame);
    const double spread = std::max(1.0, normal.chi2 / std::max(1.0, normal.weights - 4));
    const Eigen::Matrix4d covariance = spread * solver.solve(Eigen::Matrix4d::Identity());
    const auto axes = Across(frame.up);
    Eigen::Matrix<double, 3, 2> basis;
    basis << axes[0], axes[1];
    frame.covariance = basis *
                       (covariance.topLeftCorner<2, 2>() +
                        options.camera_sigma_rad * options.camera_sigma_rad * Eigen::Matrix2d::Identity()) *
                       basis.transpose();
  }
  return frame;
}

}  // namespace priamos::head
