#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/locate/place_evidence.hpp"
#include "planner/core/missions/door_views.hpp"
#include "planner/core/missions/look_sequence.hpp"
#include "planner/core/missions/mission_control.hpp"

namespace priamos::planner {

/// How candidates are looked at.
struct LocateLooksConfig {
  double speed_m_s = 0.25;
  double lead = 5;        ///< log-odds by which a place whose door was seen is believed
  double missed = 1.5;    ///< log-odds against a place where a door was not seen: things may hide it
  double other_side = 2;  ///< and against one from which the other side of a door that was seen should be
  int most_views = 4;     ///< of the doors of one place
  int most_stops = 4;     ///< on the ways to them
  double back_m = 0.5;    ///< it goes back so far from what stopped it
  LookConfig looks{.timeout_s = 5, .failures = 4, .looks = 16};

  void Describe(Archive& a);
};

/// A place that may be the one, and how well the walls tell it.
struct PlaceHypothesis {
  Pose2 map_from_way;
  double sigma_m = 0.2, sigma_yaw_rad = 0.05;
  double score = 0;   ///< by the walls
  double missed = 0;  ///< log-odds against it, by doors that were not seen ...
  double seen = 0;    ///< ... and by doors that were seen where it has none
  int matched = 0;
  int views = 0, stops = 0;
  bool wide = false;       ///< its door was seen, but not where it was expected
  bool held = true;        ///< it is a place; of a stretch no look shows anything
  bool confirmed = false;  ///< its own door was seen, from its own side
  std::vector<SpentView> spent{};

  double weight() const { return score - missed - seen; }
};

/// Decides between candidates by the doors that are seen from some of them and not from others: tells the
/// robot that it is at the likeliest, drives to where it sees such a door, and looks. A door that is seen
/// twice rules out the places that have none there, and one that leads by then is believed, if it was its own
/// door, from its own side; a door that is not seen makes its place less likely, and the likeliest is next,
/// from elsewhere. The door is looked at on the way to a view, too. What is to be seen from where the base
/// stands is looked at before it drives. What stops the base is gone around, from some way back.
class LocateLooks {
 public:
  /// kSeen: the place of tested() is believed; the robot believes to be there.
  enum class Progress { kUnderWay, kSeen, kRefused, kNothingLeft };

  LocateLooks(const LocateLooksConfig& config, const RoutePlannerConfig& route, const Footprint& footprint,
              const GroundPlan& plan);

  void Reset();
  /// Takes the candidates as they were found last; what was seen of them stays known.
  void Take(const PlaceEvidence& evidence);
  /// Orders the next look; kNothingLeft: no door tells any of the candidates from the others, or all were
  /// looked for.
  Progress Next(MissionControl& control, PlaceEvidence& evidence);
  Progress Step(MissionControl& control, PlaceEvidence& evidence);
  /// Something is in the way.
  Progress OnBlocked(MissionControl& control, PlaceEvidence& evidence);

  /// Whether it drives to a view, or back from what stopped it.
  bool IsOnItsWay() const { return stage_ == Stage::kDriving || stage_ == Stage::kBackingOff; }
  /// The places that none is ahead of by the lead, likeliest first: map_from_way.
  std::vector<Pose2> Rivals() const;
  /// Whether a door was seen, but places are left that have one there.
  bool IsUndecided() const;
  const std::vector<PlaceHypothesis>& hypotheses() const { return hypotheses_; }
  /// The one that is looked at, or was seen.
  const PlaceHypothesis& tested() const { return hypotheses_[test_]; }
  std::size_t test() const { return test_; }
  /// What it is doing, in words.
  const std::string& doing() const { return doing_; }

 private:
  enum class Stage { kPlacing, kDriving, kBackingOff, kLooking, kConcluding };

  Progress Approach(MissionControl& control, PlaceEvidence& evidence);
  bool IsInPassing(const Pose2& map_from_base) const;
  Progress Look(MissionControl& control, PlaceEvidence& evidence);
  Progress Seen(MissionControl& control, PlaceEvidence& evidence);
  void Weigh();
  bool Leads(std::size_t which) const;
  bool IsSeen(const PlaceHypothesis& hypothesis) const;
  std::vector<std::size_t> ByWeight() const;
  void Place(MissionControl& control, const PlaceEvidence& evidence, std::size_t which);
  enum class From { kHere, kAnywhere };
  std::optional<DoorView> ViewOf(std::size_t which, const Pose2& place, const PlaceEvidence& evidence,
                                 From from);
  double MissedBy(const PlaceHypothesis& hypothesis) const;
  bool IsToBeLookedAt(const PlaceHypothesis& hypothesis) const;
  Progress Test(MissionControl& control, PlaceEvidence& evidence, std::size_t which, DoorView view);
  void Spend(PlaceHypothesis& hypothesis);

  LocateLooksConfig config_;
  GroundPlan plan_;
  DoorViews views_;
  LookSequence looks_;
  Stage stage_ = Stage::kPlacing;
  std::vector<PlaceHypothesis> hypotheses_;
  std::size_t test_ = 0;
  std::optional<std::size_t> placed_;  ///< the robot believes to be there
  std::optional<DoorView> view_;
  std::vector<Pose2> sightings_;  ///< doors that were seen: way_from_door
  int n_good_ = 0;                ///< looks that found the door ...
  int n_elsewhere_ = 0;           ///< ... that found it beside where it was expected ...
  int n_missed_ = 0;              ///< ... that found none ...
  int n_models_ = 0;              ///< ... and for which the head had no model, or gave no answer
  std::string doing_, seen_;      ///< seen_: as it was when a door was seen last
};

}  // namespace priamos::planner
