#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/learned/learned_walls.hpp"
#include "planner/core/explore/explored_grid.hpp"
#include "planner/core/explore/frontiers.hpp"
#include "planner/core/explore/grid_ways.hpp"
#include "planner/core/explore/possible_floor.hpp"
#include "planner/core/map/learned_obstacles.hpp"

namespace priamos::planner {

/// Which frontier is next. All costs are metres driven.
struct ExplorationConfig {
  ExploredGridConfig grid{};
  /// The first on the shortest way over all; or, for comparison, "cost": the one that costs least, or
  /// "nearest": the rule of m-explore.
  std::string rule = "tour";
  double least_frontier_m = 0.6;  ///< a shorter frontier leads nowhere
  double turn_m = 1.0;            ///< turning by a radian to face it
  double tight_m = 2.0;           ///< per metre that is missing to `roomy_m` from what is closed
  double roomy_m = 1.0;
  double length_gain = 0.3;    ///< what a metre of frontier is worth ...
  double most_length_m = 4;    ///< ... up to this length
  double sight_m = 2;          ///< what was so near, with nothing in between, is not worth a drive
  double least_gain_m2 = 0.8;  ///< a frontier with less possible floor in sight is left unseen
  double again_gain_m2 = 3.0;  ///< nor is one tried again that leads to less in all ...
  double gain_m2_per_m = 1.0;  ///< ... or to less for each metre of the way to it
  double again_m = 10;         ///< a round over what was left costs no more than this ...
  double again_share =
      0.25;                ///< ... and this share of what was driven before, but to what is behind an opening
  double beyond_m = 1.0;   ///< the base drives so far into the unknown, as far as nothing is known there
  double farthest_m = 80;  ///< from where it began; what lies beyond is left

  void Describe(Archive& a);
};

/// A frontier that is to be driven to.
struct FrontierGoal {
  Eigen::Vector2d target{0, 0};  ///< place on the frontier
  Eigen::Vector2d goal{0, 0};    ///< where the base centre is to be: there, or a bit beyond
  double way_m = 0;              ///< to the target over what is free
  double length_m = 0;           ///< of the frontier
  double gain_m2 = 0;            ///< possible floor in sight from it; when it is tried again, all behind it
};

/// A frontier that is not driven to, and why.
struct LeftFrontier {
  Eigen::Vector2d middle{0, 0};
  double length_m = 0;
  std::string reason;
};

/// What is known of a floor on which a robot began without a plan, and where to go next. It always ends:
/// each frontier that is chosen is either seen, which makes the unknown smaller, or given up for good.
class Exploration {
 public:
  /// `width_m` of the passage that the base needs; `known` is closed from the beginning.
  Exploration(const ExplorationConfig& config, double width_m, std::vector<Rectangle> known);

  void Reset();
  /// Changes the rule and its costs.
  void set_config(const ExplorationConfig& config) { config_ = config; }
  /// The base is here, map frame. Returns whether its trail has one place more.
  bool NoteAt(const Pose2& map_from_base);
  /// The places of the trail, as many as there are, as the map has them now. What stopped the base, and what
  /// was given up, moves with where it was then.
  void MoveTrail(const std::vector<Pose2>& trail);
  /// Walls, and things that the head saw, as they are known by now, in place of those before. Edges that were
  /// reported as walls are none, and where the base drove through nothing is.
  void Learn(const LearnedWalls& walls, const std::vector<NamedObstacle>& seen = {});
  /// What counts of them.
  const LearnedWalls& walls() const { return evidence_.walls; }
  /// Those that a way keeps off: as far as they surely reach, and the corners of rooms, through which nothing
  /// leads.
  LearnedWalls WallsForWays();
  /// Something that is no wall is here, of which one side is known only: it is made smaller as far as it
  /// would close a way that the base has driven. Returns whether anything is left of it.
  bool AddThing(Rectangle thing);
  /// Whether what was heard there, from a base at `from`, can be a wall, an edge or a thing that is known: an
  /// echo lies anywhere on an arc.
  bool Knows(const Eigen::Vector2d& heard, const Eigen::Vector2d& from) const;
  /// What is around this place of a frontier is not tried, or, `for_good`, never again.
  void GiveUp(const Eigen::Vector2d& target, std::string reason, bool for_good = false);

  /// Forgets what stopped the base and what was given up, but for good: a thing is known by one side only,
  /// and may have been a person. From then on, until a room has been seen, only frontiers with much behind
  /// them count, for the way that leads to them, and each is tried once, as far as the cost of the round
  /// allows. False: there is nothing to forget.
  bool TryAgain();
  bool again() const { return again_; }  ///< whether it was done

  /// The way back to where the base began, without the loops, as far as `length_m`: it was there with its
  /// whole body, at the headings that the poses have. Empty where it began.
  std::vector<Pose2> WayBack(double length_m) const;
  /// The way on that the base took when it was here for the first time, as far as `length_m`: for a base that
  /// is about to leave a room, the way back leads ahead. Empty where it had not been before.
  std::vector<Pose2> WayOn(double length_m) const;

  /// The frontier that is next; nullopt: nothing is left that can be reached.
  std::optional<FrontierGoal> Choose(const Pose2& map_from_base);
  /// Whether a frontier is worth a way of that length, which may be longer than the one over what is free.
  bool IsWorth(const FrontierGoal& goal, double length_m) const;
  /// Whether the frontier is still there at its place.
  bool IsOpen(const FrontierGoal& goal);
  /// The frontiers that Choose() left, longest first.
  const std::vector<LeftFrontier>& left() const { return left_; }
  /// What stopped the base, what the head saw, corners and edges: what a way keeps off beside walls.
  std::vector<NamedObstacle> ThingsForWays() const;
  /// Unknown cells beside free ones, but for those around the goal.
  std::vector<NamedObstacle> UnknownFor(const FrontierGoal& goal);

  const ExploredGrid& grid();
  double driven_m() const { return driven_m_; }
  /// How far from where it began the base has been.
  double reached_m() const;

 private:
  /// Middles of cells stand for places that are up to half a diagonal away.
  static constexpr double kRaster_m = 0.05;
  struct GivenUp {
    Eigen::Vector2d at;
    std::string reason;
    std::size_t from = 0;  ///< place of the trail where the base was then
    bool for_good = false;
  };
  struct Candidate {
    FrontierGoal goal;
    Eigen::Vector2i cell{0, 0};
    double cost = 0;
  };
  std::optional<Candidate> Best(const Frontier& frontier, const GridWays& ways, const Pose2& base) const;
  double CostOf(const Frontier& frontier, const Eigen::Vector2i& cell, const GridWays& ways,
                const Pose2& base) const;
  bool IsKnown(const Eigen::Vector2d& place) const;
  bool ClosesTrail(const Rectangle& thing) const;
  void DropDrivenOver(const Eigen::Vector2d& at);
  std::size_t Here() const;
  std::size_t FirstAt(const Eigen::Vector2d& place) const;
  static std::size_t FirstOf(const std::vector<Candidate>& candidates, const GridWays& ways);
  const GivenUp* FindGivenUp(const Eigen::Vector2d& at) const;
  bool IsBehindOpening(const Eigen::Vector2d& place) const;
  bool IsCrumb(const Frontier& frontier) const;
  const PossibleFloor& possible();
  void Forget();
  double Gain_m2(const Eigen::Vector2i& cell) const;
  double LeastGain_m2(double way_m) const;
  double MostWay_m() const;
  std::string WhyLeft(const Frontier& frontier, const GridWays& ways) const;
  Eigen::Vector2d GoalBeyond(const Eigen::Vector2i& cell, const GridWays& ways) const;
  Eigen::Vector2d Outward(const Eigen::Vector2i& cell) const;

  ExplorationConfig config_;
  double clearance_m_;
  std::vector<Rectangle> known_;
  ExploredEvidence evidence_;
  std::vector<Pose2> poses_;              ///< at the places of the trail
  std::vector<std::size_t> things_from_;  ///< where the base was when it put each thing that is not known
  std::vector<GivenUp> given_up_;
  std::vector<LeftFrontier> left_;
  std::optional<ExploredGrid> grid_;       ///< of the evidence; none: it has changed since
  std::optional<PossibleFloor> possible_;  ///< of the grid
  std::optional<Eigen::Vector2d> last_;
  double driven_m_ = 0;
  bool again_ = false;        ///< what was given up is tried again
  double again_from_m2_ = 0;  ///< what was seen when that began ...
  double again_from_m_ = 0;   ///< ... and what had been driven
};

}  // namespace priamos::planner
