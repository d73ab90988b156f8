#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/core/missions/mission_types.hpp"

/// What a person orders of a planner: steps in their turn, as often as wanted.
namespace priamos::planner {

/// One step of an order: a mission, or standing for a while.
struct AgendaStep {
  MissionOrder order;
  std::optional<double> wait_s{};  ///< stand for so long; `order` does not count then
};

/// An order: its steps in turn, `rounds` times.
struct AgendaOrder {
  int id = 0;  ///< the sender's; 0: the agenda gives one
  std::string title{};
  std::vector<AgendaStep> steps;
  int rounds = 1;  ///< 0: until it is cancelled
};

/// How an order or a step can end.
enum class AgendaEnd { kDone, kFailed, kCancelled, kRefused };

/// How an order, or one of its steps, has ended.
struct AgendaResult {
  int order_id = 0;
  int step = 0;  ///< from 1 on; 0: the order as a whole
  int round = 0;
  AgendaEnd end = AgendaEnd::kDone;
  double took_s = 0;
  std::string text;  ///< what was reached, or the reason
};

/// Kinds of MissionOrder by their numbers in the mission table; the first two lead through doors.
struct AgendaKinds {
  int go = 0;        ///< to a place
  int pass = 0;      ///< through a door
  int follow = -1;   ///< along a corridor
  int explore = -1;  ///< an unknown floor
  int locate = -1;   ///< the robot finds out where it is
};

/// Planned speeds of the two, with which the time left is computed.
struct AgendaSpeeds {
  double go_m_s = 0.3, pass_m_s = 0.3;
};

}  // namespace priamos::planner
