#include "head/core/floor/floor_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr std::size_t kBlocks = 12;  ///< of a line
constexpr double kMostVoices = 3;    ///< by which a short line may count more than it has points
constexpr double kGate_m = 0.006;    ///< a block is on a floor or not
constexpr double kPerGate = 1 / (kGate_m * kGate_m);
constexpr double kFarthest = 16;  ///< squared Mahalanobis distance of a floor from the prior
/// Points that one unit of it outweighs. Of two lines a step may carry all of one: then the points are even,
/// and what decides is which of both floors the robot can stand on so.
constexpr double kPriorWeight = 2, kPriorWeightOfSeveral = 12;
constexpr double kInlier = 9;  ///< square of the sigmas within which a point is on the floor
constexpr int kRefinements = 3;

/// Neighbouring points as one: that of median height.
struct Block {
  Eigen::Vector3d at;
  double n = 0;
};

using Line = std::span<const LightPoint>;

void AddBlocks(Line points, double weight, std::vector<Block>& blocks) {
  const std::size_t size = std::max<std::size_t>(1, (points.size() + kBlocks - 1) / kBlocks);
  std::vector<std::size_t> order;
  for (std::size_t first = 0; first < points.size(); first += size) {
    const std::size_t last = std::min(points.size(), first + size);
    order.clear();
    for (std::size_t i = first; i < last; ++i) order.push_back(i);
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), middle, order.end(),
                     [&](std::size_t a, std::size_t b) { return points[a].at.z() < points[b].at.z(); });
    blocks.push_back({points[*middle].at, weight * static_cast<double>(last - first)});
  }
}

std::vector<Line> SplitLines(Line points) {
  std::vector<Line> lines;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    while (end < points.size() && points[end].line == points[begin].line) ++end;
    lines.push_back(points.subspan(begin, end - begin));
  }
  return lines;
}

struct Blocks {
  std::vector<Block> all;
  std::size_t lines = 0;
};

Blocks MakeBlocks(std::span<const LightPoint> points) {
  const std::vector<Line> lines = SplitLines(points);
  Blocks blocks{{}, lines.size()};
  for (const Line& line : lines) {
    const auto all = static_cast<double>(points.size()), own = static_cast<double>(line.size());
    AddBlocks(line, std::min(kMostVoices, all / own / static_cast<double>(lines.size())), blocks.all);
  }
  return blocks;
}

/// Sums of a weighted least squares fit with a prior.
struct Sums {
  Eigen::Matrix3d information;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();

  explicit Sums(const Eigen::Matrix3d& prior_information) : information(prior_information) {}
  void Add(const Eigen::Vector3d& p, double weight) {
    const Eigen::Vector3d row = FloorPlane::Row(p);
    information += weight * row * row.transpose();
    vector += weight * p.z() * row;
  }
  Eigen::Matrix3d Covariance() const { return information.inverse(); }
};

double Score(const Blocks& blocks, const Eigen::Vector3d& plane, const Eigen::Matrix3d& prior_information) {
  const double distance = plane.dot(prior_information * plane);
  if (!(distance < kFarthest)) return -1e9;
  double score = -(blocks.lines > 1 ? kPriorWeightOfSeveral : kPriorWeight) * distance;
  for (const Block& b : blocks.all) {
    const double height = b.at.z() - plane[0] - plane[1] * b.at.x() - plane[2] * b.at.y();
    score += b.n * std::max(0.0, 1 - height * height * kPerGate);
  }
  return score;
}

/// The best of the floors through one or two blocks.
Eigen::Vector3d Guess(const Blocks& blocks, const Eigen::Matrix3d& prior_information) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_score = Score(blocks, best, prior_information);
  constexpr double kWeight = 1 / (0.002 * 0.002);
  const std::vector<Block>& all = blocks.all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i; j < all.size(); ++j) {
      Sums sums(prior_information);
      sums.Add(all[i].at, kWeight);
      if (j != i) sums.Add(all[j].at, kWeight);
      const Eigen::Vector3d plane = sums.Covariance() * sums.vector;
      const double score = Score(blocks, plane, prior_information);
      if (score > best_score) {
        best = plane;
        best_score = score;
      }
    }
  }
  return best;
}

}  // namespace

FloorPlane FitFloor(std::span<const LightPoint> points, const Eigen::Matrix3d& prior) {
  const Eigen::Matrix3d prior_information = prior.inverse();
  FloorPlane floor;
  floor.plane = Guess(MakeBlocks(points), prior_information);
  floor.covariance = prior;
  for (int pass = 0; pass < kRefinements; ++pass) {
    Sums sums(prior_information);
    const double slack = pass == 0 ? kGate_m * kGate_m : 0;  // the guess went through two blocks only
    for (const LightPoint& p : points) {
      const double height = floor.HeightOf(p.at);
      if (height * height < kInlier * p.variance + slack) sums.Add(p.at, 1 / (p.variance * kColumnsPerFact));
    }
    floor.covariance = sums.Covariance();
    floor.plane = floor.covariance * sums.vector;
  }
  return floor;
}

}  // namespace priamos::head
