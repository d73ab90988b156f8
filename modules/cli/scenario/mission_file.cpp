#include "cli/scenario/mission_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "bus/process_config.hpp"
#include "cli/scenario/door_name.hpp"
#include "common/config.hpp"
#include "common/ground_plan.hpp"
#include "common/input/utf8.hpp"
#include "planner/planner_missions.hpp"

namespace priamos::cli {
namespace {

constexpr std::size_t kMostSteps = 32, kLongestTitle = 60;

/// Steps without repetitions.
std::size_t StepsIn(const std::vector<MissionFileStep>& steps) {
  return std::size_t(std::count_if(steps.begin(), steps.end(),
                                   [](const MissionFileStep& step) { return step.what != "repeat"; }));
}

void CheckNumber(std::size_t n, const MissionFile& file) {
  if (n > kMostSteps)
    throw ConfigError(
        fmt::format("{}expected at most {} steps, got {}", file.steps.back().place.Begin(), kMostSteps, n));
}

/// Follows the steps on the plan, from place to place.
class Rehearsal {
 public:
  Rehearsal(const planner::PlannerConfig& config, const GroundPlan& plan)
      : plan_(plan), router_(planner::MakeRouter(config, plan)) {}

  /// Why the step cannot be done after those before; nullopt: it can, as far as the plan says.
  std::optional<std::string> Do(const mission_step_t& step) {
    if (step.mission == mission_command_t::GOTO)
      return Drive({{step.x_m, step.y_m, step.yaw_rad}, step.turn != 0});
    if (step.mission == mission_command_t::PASS_DOOR) return Pass(step.landmark_id);
    // Where a corridor ends is seen when it does.
    if (step.mission == mission_command_t::CORRIDOR || step.mission == mission_command_t::EXPLORE ||
        step.mission == mission_command_t::LOCATE)
      at_.reset();
    return std::nullopt;
  }

  /// Where the base has come into the cabin of a door; nullopt: it leads into none.
  std::optional<Pose2> InCabin(int door_id) const { return router_.PlaceInCabin(door_id); }

 private:
  std::optional<std::string> Drive(const planner::Goal& goal) {
    // Of the first step nobody knows from where: whether the base fits at its end.
    const auto legs = router_.Plan(at_.value_or(goal.map_from_base), goal);
    if (!legs) return legs.reason();
    at_ = goal.map_from_base;
    return std::nullopt;
  }
  std::optional<std::string> Pass(int door_id) {
    if (!plan_.FindDoor(door_id)) return fmt::format("the map has no door {}", door_id);
    // Of the first step nobody knows from which side, but for a cabin.
    const auto cabin = router_.PlaceInCabin(door_id);
    at_ = at_ ? std::optional(router_.PlanThrough(*at_, door_id).back().goal.map_from_base) : cabin;
    return std::nullopt;
  }

  GroundPlan plan_;
  planner::DoorRouter router_;
  std::optional<Pose2> at_;
};

mission_step_t DriveTo(const Pose2& place, bool turn) {
  mission_step_t message{};
  message.mission = mission_command_t::GOTO;
  message.x_m = place.x;
  message.y_m = place.y;
  message.turn = turn;
  message.yaw_rad = WrapAngle(place.yaw);
  return message;
}

mission_step_t PassDoor(const MissionFileStep& step, const GroundPlan& plan, const std::string& map) {
  mission_step_t message{};
  message.mission = mission_command_t::PASS_DOOR;
  try {
    message.landmark_id = static_cast<std::int16_t>(DoorNamed(plan, step.door, map));
  } catch (const ConfigError& error) {
    throw ConfigError(step.place.Begin() + error.what());
  }
  return message;
}

mission_step_t Stand(double wait_s) {
  mission_step_t message{};
  message.mission = mission_command_t::WAIT;
  message.wait_s = wait_s;
  return message;
}

mission_step_t ToMessage(const MissionFileStep& step, const GroundPlan& plan, const std::string& map) {
  if (step.what == "goto")
    return DriveTo({step.x_m, step.y_m, Radians(step.yaw_deg.value_or(0))}, step.yaw_deg.has_value());
  if (step.what == "door") return PassDoor(step, plan, map);
  if (step.what == "wait") return Stand(step.wait_s);
  mission_step_t message{};
  message.mission = step.what == "explore"  ? mission_command_t::EXPLORE
                    : step.what == "locate" ? mission_command_t::LOCATE
                                            : mission_command_t::CORRIDOR;
  message.distance_m = static_cast<float>(step.distance_m);
  return message;
}

/// Into the cabin, the ride, and out again.
std::vector<mission_step_t> RideOf(const MissionFileStep& step, const Rehearsal& rehearsal,
                                   const mission_step_t& pass) {
  const auto inside = rehearsal.InCabin(pass.landmark_id);
  if (!inside)
    throw ConfigError(
        fmt::format("{}door {} leads into no cabin, a room with no place to look at it from; "
                    "next: pass it with do = \"door\", there and back",
                    step.place.Begin(), step.door));
  std::vector<mission_step_t> ride{pass};
  if (step.turn) ride.push_back(DriveTo(*inside * Pose2{0, 0, kPi}, true));
  ride.push_back(Stand(step.wait_s));
  ride.push_back(pass);
  return ride;
}

std::vector<mission_step_t> MessagesOf(const MissionFileStep& step, const Rehearsal& rehearsal,
                                       const GroundPlan& plan, const std::string& map) {
  if (step.what == "elevator") return RideOf(step, rehearsal, PassDoor(step, plan, map));
  return {ToMessage(step, plan, map)};
}

/// Appends the steps that a `repeat` names, so often.
void Repeat(const MissionFileStep& repeat, std::size_t number, std::vector<std::size_t> first,
            std::vector<mission_step_t>& steps) {
  if (repeat.from < 1 || std::size_t(repeat.from) >= number)
    throw ConfigError(fmt::format("{}from: expected the number of a step before this one, the {}., got {}",
                                  repeat.place.Begin(), number, repeat.from));
  const std::vector<mission_step_t> again(steps.begin() + std::ptrdiff_t(first[std::size_t(repeat.from - 1)]),
                                          steps.end());
  if (steps.size() + again.size() * std::size_t(repeat.times) > kMostSteps)
    throw ConfigError(fmt::format("{}times: expected at most {} steps with all repetitions, got {}",
                                  repeat.place.Begin(), kMostSteps,
                                  steps.size() + again.size() * std::size_t(repeat.times)));
  for (int i = 0; i < repeat.times; ++i) steps.insert(steps.end(), again.begin(), again.end());
}

}  // namespace

void MissionFileStep::Describe(Archive& a) {
  NotePlace(a, place);
  a.Choice("do", what, {"goto", "door", "elevator", "corridor", "explore", "locate", "wait", "repeat"},
           "what is done in this step");
  if (what == "goto") {
    a.Require("x_m", "a place, x_m and y_m");
    a.Require("y_m", "a place, x_m and y_m");
    a.Number("x_m", x_m, {"m", -100, 100, "map frame"});
    a.Number("y_m", y_m, {"m", -100, 100, "map frame"});
    double yaw = yaw_deg.value_or(std::numeric_limits<double>::quiet_NaN());
    a.Number("yaw_deg", yaw, {"deg", -360, 360, "heading at the place; as it suits the path if not given"});
    if (!std::isnan(yaw)) yaw_deg = yaw;
  } else if (what == "door") {
    a.Require("door", "the door's name in the map, or its number");
    a.Text("door", door, "its name in the map, or its number");
  } else if (what == "elevator") {
    a.Require("door", "the name of the cabin's door in the map, or its number");
    a.Text("door", door, "its name in the map, or its number");
    a.Number("wait_s", wait_s, {"s", 0, 36000, "how long the ride takes"});
    a.Flag("turn", turn, "turn round in the cabin, which needs more room than the base's diagonal");
  } else if (what == "corridor") {
    a.Number("distance_m", distance_m, {"m", 0, 180, "how far the corridor is followed; 0: to its end"});
  } else if (what == "explore" || what == "locate") {
    // Nothing more is to be said.
  } else if (what == "wait") {
    a.Require("wait_s", "how long");
    a.Number("wait_s", wait_s, {"s", 0, 36000, "how long the robot stands"});
  } else {
    a.Integer("from", from, {"-", 1, 32, "the first of the steps before this one that are done again"});
    a.Integer("times", times, {"-", 1, 32, "how often they are done again"});
  }
}

void MissionFile::Describe(Archive& a) {
  a.Text("title", title, "what the robot does, in a few words");
  if (title.size() > kLongestTitle) a.Refuse("title", "at most 60 bytes");
  if (std::any_of(title.begin(), title.end(), IsControl))
    a.Refuse("title", "text without control characters");
  a.Integer("rounds", rounds, {"-", 0, 9999, "how often all steps are done; 0: until it is cancelled"});
  a.List("step", steps, "the steps, in turn");
  if (steps.empty()) a.Refuse("step", "one or more [[step]]");
}

mission_command_t OrderOf(const MissionFile& file, const planner::PlannerConfig& config,
                          const GroundPlan& plan, const std::string& map) {
  CheckNumber(StepsIn(file.steps), file);  // before any way is planned, which takes a while
  mission_command_t order{};
  order.mission = mission_command_t::RUN;
  order.title = file.title;
  order.rounds = static_cast<std::int16_t>(file.rounds);
  Rehearsal rehearsal(config, plan);
  std::vector<std::size_t> first;  // of the order's steps, by the number in the file
  for (const MissionFileStep& step : file.steps) {
    first.push_back(order.steps.size());
    if (step.what == "repeat") {
      Repeat(step, first.size(), first, order.steps);
      continue;
    }
    for (const mission_step_t& message : MessagesOf(step, rehearsal, plan, map)) {
      order.steps.push_back(message);
      if (const auto why = rehearsal.Do(message)) throw ConfigError(step.place.Begin() + *why);
    }
  }
  CheckNumber(order.steps.size(), file);
  const MissionFileStep& begin = file.steps.front();
  if (file.rounds != 1)
    if (const auto why = rehearsal.Do(order.steps.front()))
      throw ConfigError(begin.place.Begin() + "next round: " + *why);
  order.n_steps = static_cast<std::int8_t>(order.steps.size());
  return order;
}

mission_command_t OrderOfFile(const std::string& file, const ConfigSource& planner) {
  return OrderOf(LoadConfig<MissionFile>(file), planner);
}

mission_command_t OrderOf(const MissionFile& file, const ConfigSource& planner) {
  const auto config = bus::LoadAppConfig<planner::PlannerConfig>(planner);
  const std::string map = (std::filesystem::path(planner.Folder()) / config.map).lexically_normal().string();
  return OrderOf(file, config, LoadConfig<GroundPlan>(map), map);
}

}  // namespace priamos::cli
