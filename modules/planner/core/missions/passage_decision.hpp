#pragma once

#include <Eigen/Core>
#include <string>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/path/footprint.hpp"
#include "planner/core/path/passage_uncertainty.hpp"

namespace priamos::planner {

/// Where the pose is judged on the way through a door. Distances are from the base centre to the door's
/// plane.
struct PassageRules {
  double last_look_m = 0.75;  ///< from here the last look is expected: what the wheels add counts from there
  double commit_m = 0.85;     ///< from here a base at full speed can still end before the opening
  double slow_commit_m = 0.68;  ///< from here a slow one can
  double tracking_m = 0.005;    ///< largest deviation of the path following in the door
  DriftModel drift;

  void Describe(Archive& a);
};

/// The pose's uncertainty in the plane of a door, and what it leaves of the gap there.
struct PassageProspect {
  PassageUncertainty uncertainty;
  double gap_m = 0;  ///< free beside the base at 2 sigma; negative: it may touch

  bool Fits() const { return gap_m >= 0; }
  std::string Text() const;
};

/// What to do on the way to the opening. kWait: drive on as ordered, and judge the next pose.
enum class PassageStep { kWait, kSlowDown, kEnter, kGoBack };

/// Whether the base may enter the opening of a door. It sets out when the pose would do if looks go on to
/// `last_look_m`. They may be worse than expected, so the pose is judged again at the last place from which
/// the base can end before the opening. Where looks from still nearer would do, it goes slower instead, and
/// is judged at the last place from which a slow base can: a door with little beside the base takes some
/// seconds more.
class PassageDecision {
 public:
  PassageDecision(const PassageRules& rules, const Footprint& footprint)
      : rules_(rules), footprint_(footprint) {}

  void set_rules(const PassageRules& rules) { rules_ = rules; }

  /// The prospect for a base `distance_m` before the plane of the door whose pose has this covariance (map:
  /// x, y, yaw), if looks keep it as good down to `last_look_m`.
  PassageProspect Expect(const DoorPlan& door, const Eigen::Matrix3d& covariance, double distance_m,
                         double last_look_m) const;
  /// The same, for setting out.
  PassageProspect Expect(const DoorPlan& door, const Eigen::Matrix3d& covariance, double distance_m) const {
    return Expect(door, covariance, distance_m, rules_.last_look_m);
  }

  /// A base sets out for the opening.
  void Begin() { settled_ = slow_ = false; }
  /// What to do now. kEnter, kSlowDown and kGoBack are said once.
  PassageStep Next(const DoorPlan& door, const Eigen::Matrix3d& covariance, double distance_m);

 private:
  PassageRules rules_;
  Footprint footprint_;
  bool settled_ = false;  ///< it was said that the base enters the opening, or goes back
  bool slow_ = false;
};

}  // namespace priamos::planner
