#pragma once

#include <optional>
#include <string>

#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

/// Notices that a robot does not know where it is: its own pose says so, or what it sees contradicts its
/// pose. It stays lost until its pose is set, by a person or by the mission that finds out where it is, or
/// until a landmark fits again.
class LostWatch {
 public:
  /// What became of a look, or of an order to set the pose.
  void Note(const LookResult& result);
  /// What contradicts the pose; nullopt: nothing does.
  std::optional<std::string> Why(const std::optional<RobotPose>& pose) const;

 private:
  int n_refused_ = 0;  ///< landmarks in a row that were seen where they cannot be
};

}  // namespace priamos::planner
