#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"
#include "planner/core/locate/driven_way.hpp"
#include "planner/core/locate/met_things.hpp"
#include "planner/core/locate/place_plan.hpp"
#include "planner/core/locate/place_search.hpp"

namespace priamos::planner {

/// What a robot has driven and heard since it does not know where it is, and which places of the plan explain
/// it.
class PlaceEvidence {
 public:
  PlaceEvidence(const PlaceSearchConfig& config, const GroundPlan& plan) : config_(config), plan_(plan) {}

  /// Forgets everything; what is heard from now on counts.
  void Begin(Time now);
  /// As WayLog::OnPose().
  void OnPose(Time stamp, const Pose2& told_from_base, std::optional<Time> corrected) {
    log_.OnPose(stamp, told_from_base, corrected);
  }
  /// A feature that the robot reported now: walls count.
  void OnFeature(const SeenFeature& seen, Time now);

  /// Weighs all places of the plan anew, when there is something new to weigh them by.
  const std::vector<PlaceCandidate>& Search();
  /// The same with another margin, for a place that nothing else confirms.
  std::vector<PlaceCandidate> SearchWithin(double margin) const;
  /// As Search() left them, where the base was then.
  const std::vector<PlaceCandidate>& found() const { return found_; }
  /// Those that are worse than the best by no more than `lead`. One that is farther behind is out as soon as
  /// something else speaks for the best.
  std::vector<PlaceCandidate> Rivals(double lead) const;
  /// Candidates that the walls hold: only from a place there is a view.
  int CountHeld() const;

  const WayLog& log() const { return log_; }
  /// What the base met, frame of the way.
  const MetThings& met() const { return met_; }
  MetThings& met() { return met_; }
  const PlacePlan& plan() const { return plan_; }
  /// When walls were told last.
  Time changed() const { return changed_; }

 private:
  PlaceSearchConfig config_;
  PlacePlan plan_;
  WayLog log_;
  MetThings met_;
  std::size_t searched_ = 0;  ///< revision of the log
  double searched_at_m_ = 0;  ///< way driven by then
  std::vector<PlaceCandidate> found_;
  Time changed_{};
};

/// The walls that were heard, where they are if the frame of the way lies so on the map. What the base drove
/// over is none: it is an echo of an echo, or has gone.
LearnedWalls WallsAt(const DrivenWay& way, const Pose2& map_from_way);

}  // namespace priamos::planner
