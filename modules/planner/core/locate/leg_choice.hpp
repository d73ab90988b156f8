#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "planner/core/locate/driven_way.hpp"
#include "planner/core/locate/place_plan.hpp"

namespace priamos::planner {

/// How a robot that does not know where it is looks around.
struct LegChoiceConfig {
  double least_m = 0.6;      ///< a shorter leg tells nothing new: a wall is one after 0.8 m driven along it
  double first_m = 2.0;      ///< length of a leg into the unknown ...
  double longest_m = 6.0;    ///< ... which doubles as long as it leads on the same way
  double keep_m = 0.75;      ///< from the middle of the base to walls that were heard
  double seen_m = 0.5;       ///< what lies nearer to the way driven is known
  double least_new_m = 0.3;  ///< of a leg, in unknown surroundings
  double back_gain = 0.2;    ///< metres in the unknown that a metre driven back has to show
  double told_gain = 1;      ///< of a leg, for each metre by which places differ in how far it can be driven
  double aligned_m = 1.5;    ///< the base turns along walls of which so much was heard

  void Describe(Archive& a);
};

/// Where the base stood when it could go no farther, and in which direction: frame of the way.
struct ClosedWay {
  Eigen::Vector2d at{0, 0}, towards{1, 0};
};

/// What else than the way tells where a leg should lead.
struct LegHints {
  std::vector<ClosedWay> closed{};
  std::vector<Rectangle> things{};  ///< in the way, frame of the way
  /// Places that explain the way about as well (map_from_way), and the plan on which they are. A leg that is
  /// longer than it could be at one of them tells it from others.
  std::vector<Pose2> rivals{};
  const PlacePlan* plan = nullptr;
};

/// The next straight leg that leads through the most that is new, and tells most of the rivals apart: along
/// or across the walls that were heard, as far as nothing is known to be in the way. Its end, frame of the
/// way, with the base along or across those walls, too, because it needs least room so; nullopt when all that
/// can be reached by such legs is known.
std::optional<Pose2> ChooseLeg(const LegChoiceConfig& config, const DrivenWay& way, const LegHints& hints);

/// Where no such leg begins here: the way back, along the way driven, to the place on it from which one leads
/// through the most that is new for the metres driven back. Corners and end of it, frame of the way, with the
/// headings that the base had there; empty when there is no such place.
std::vector<Pose2> ChooseWayBack(const LegChoiceConfig& config, const DrivenWay& way, const LegHints& hints);

/// A way driven without the loops in it: whatever the base did meanwhile, it is back where it was.
std::vector<Pose2> WithoutLoops(const std::vector<Pose2>& trail);

/// A way driven, from its place `from` (an index of the trail) to `to`, which may lie before it: corners and
/// end, so few that straight lines between them stay beside it.
std::vector<Pose2> AlongTrail(const std::vector<Pose2>& trail, std::size_t from, std::size_t to);

}  // namespace priamos::planner
