#pragma once

#include <string>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/locate/place_evidence.hpp"
#include "planner/core/missions/locate_legs.hpp"
#include "planner/core/missions/locate_looks.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/missions/path_progress.hpp"

namespace priamos::planner {

/// How long a place is looked for, and what it takes to believe one.
struct LocateMissionConfig {
  double settle_s = 9;       ///< the robot stands so long, so that the radio brings all that it heard
  int most_tests = 24;       ///< candidates that are looked at one after the other
  int rounds = 3;            ///< so often candidates are looked at, with more legs between
  double alone_margin = 16;  ///< margin at which walls alone are believed where no door can be seen ...
  int alone_walls = 5;       ///< ... and so many of them
  double stands_s = 8;       ///< a robot that comes no farther on its path for so long is blocked
  double thing_m = 0.4;      ///< size that what stops it is taken to have
  double drift_m = 0.3;      ///< of the pose, one sigma, at which it counts as exact anew: it is relative
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 3, .silent_s = 8, .limit_s = 800};
  PlaceSearchConfig search;
  LocateLegsConfig legs;
  LocateLooksConfig looks;

  void Describe(Archive& a);
};

/// The mission "where am I?": finds out where on the plan the robot is, whatever its pose says. It drives
/// without a map and collects walls (LocateLegs) until few places on the plan explain them, or nothing new
/// can be heard; then it looks at doors that tell these apart (LocateLooks), and drives on where they do not.
/// It believes what was seen twice; the pose is taken back when nothing is. Where places cannot be told apart
/// it ends "ambiguous".
class LocateMission : public Mission {
 public:
  LocateMission(const LocateMissionConfig& config, const RoutePlannerConfig& route,
                const Footprint& footprint, const GroundPlan& plan);

  std::optional<Refusal> Start(const MissionOrder& order) override;
  void Step(MissionControl& control) override;
  void OnStop(MissionControl& control, const Stop& stop) override;
  void OnEnded(MissionControl& control) override;
  const MissionLimits& limits() const override { return config_.limits; }
  std::string Unfinished() const override;

 private:
  enum class Stage { kFraming, kLegs, kSettling, kLooks, kGivingBack };

  void NoteStop(const MissionControl& control);
  bool ComesNoFarther(const MissionControl& control);
  void Listen(const MissionControl& control);
  void Frame(MissionControl& control);
  bool IsPlaced(const MissionControl& control) const;
  bool OrderLeg(MissionControl& control);
  void NextLeg(MissionControl& control);
  void EndLeg(MissionControl& control);
  bool HasSettled(const MissionControl& control) const;
  void Decide(MissionControl& control);
  void Follow(MissionControl& control, LocateLooks::Progress progress);
  void AfterLooks(MissionControl& control);
  void Believe(MissionControl& control);
  void BelieveWalls(MissionControl& control);
  void GiveUp(MissionControl& control, std::string reason);
  void GiveBack(MissionControl& control);
  std::string Candidates() const;
  void Tell(MissionControl& control, const std::string& what) const;

  LocateMissionConfig config_;
  Footprint footprint_;
  PlaceEvidence evidence_;
  LocateLegs legs_;
  LocateLooks looks_;
  Stage stage_ = Stage::kFraming;
  int round_ = 0;
  Time stands_since_{};  ///< the end of the newest leg
  std::string outcome_;  ///< reason with which the mission ends after the pose was given back
  StandWatch holds_{StandWatch::Counts::kHeld}, idles_{StandWatch::Counts::kFree};
  bool framed_ = false;  ///< the robot's pose is one of this mission
};

}  // namespace priamos::planner
