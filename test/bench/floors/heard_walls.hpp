#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cli/floor/true_floor.hpp"
#include "common/learned/learned_walls.hpp"
#include "common/random.hpp"

namespace priamos::bench {

/// What a base tells of the walls of a true floor, by a rule in place of sonars: a face is heard where the
/// base is before it, told once 0.8 m of it are and again when 1 m more are or nothing more comes, two walls
/// every 1.2 m driven, up to 3 cm beside its place and up to 20 cm too long. Corners and edges are told as
/// soon as they are in sight, 2 m away or nearer.
class HeardWalls {
 public:
  HeardWalls(const cli::TrueWorld& world, const cli::TrueFloor& floor, std::uint64_t seed);

  /// The base is here, map frame, after so many metres.
  void HearFrom(const Eigen::Vector2d& at, double driven_m);
  /// All that was told.
  LearnedWalls Told() const { return {LearnedWalls::kVersion, revision_, told_, {}, {}, points_}; }

 private:
  struct Face {
    Eigen::Vector2d from, along, out;  ///< its end, its direction, and to where the floor is
    double length_m;
    std::vector<double> heard_m;  ///< of each 10 cm: driven until it was heard last; -1: never
  };
  /// A piece of a face that is to be told.
  struct Due {
    std::size_t face;
    int first, last, grown;
  };
  void HearEnds(const Face& face, const Eigen::Vector2d& at);
  void Hear(Face& face, const Eigen::Vector2d& at, double driven_m) const;
  bool IsSolid(const Eigen::Vector2d& at) const;
  bool IsHidden(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  std::vector<Due> DueAfter(double driven_m) const;
  void AddDue(std::size_t face, int first, int last, double driven_m, std::vector<Due>& due) const;
  void Tell(const Due& due);

  const cli::TrueFloor& floor_;
  std::vector<Face> faces_;
  std::vector<bool> solid_;
  std::vector<LearnedWall> told_;
  std::vector<LearnedPoint> points_;
  std::vector<int> cells_told_;                             ///< of each wall that was told
  std::map<std::pair<std::size_t, int>, std::size_t> ids_;  ///< face and first cell -> place in told_
  Rng rng_;
  double next_m_ = 0;
  int revision_ = 0;
};

}  // namespace priamos::bench
