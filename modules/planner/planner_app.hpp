#pragma once

#include <string_view>

#include "bus/context.hpp"
#include "common/rate_limit.hpp"
#include "lcmtypes/channels.hpp"
#include "planner/core/missions/model_queue.hpp"
#include "planner/floor_report.hpp"
#include "planner/map_keeper.hpp"
#include "planner/planner_config.hpp"
#include "planner/planner_missions.hpp"

namespace priamos::planner {

/// The workstation: carries out missions with what the radio brings. See README.md.
class PlannerApp {
 public:
  static constexpr std::string_view kName = "planner";
  static constexpr std::string_view kDefaultBus = "offboard";
  static constexpr std::string_view kSummary =
      "The robot's workstation: the building's map, and missions such as passing a door.";
  static constexpr bool kOneOwner = true;
  static constexpr bool kFollowsLogs = true;
  using Config = PlannerConfig;

  /// App of the planner; `missions` makes the table of what the planner can carry out. Throws ConfigError
  /// when the map cannot be used.
  PlannerApp(const PlannerConfig& config, bus::Context& context, MissionMaker missions = MakeMissions);

  Duration TickPeriod() const { return FromSeconds(1 / config_.rate_hz); }
  void Tick(Time now);
  /// Takes over the parameters that PlannerConfig marks as live.
  void Reconfigure(const PlannerConfig& config);

 private:
  void TakeOrders(Time now);
  void Take(const mission_command_t& order, Time now);
  void TakeReports(Time now);
  void Send(const MissionActions& actions, Time now);
  void SendStatus(Time now);
  void SendEnds(Time now);
  void TeachLandmark(int id, Time now);

  PlannerConfig config_;
  bus::Context& context_;
  GroundPlan plan_;
  MissionTable missions_;
  MapKeeper map_;
  DoorRouter router_;
  ModelQueue models_;
  Agenda agenda_;

  bus::Inbox<mission_command_t> orders_;
  bus::Latest<pose_t> poses_;
  bus::Latest<drive_status_t> drive_;
  bus::Inbox<landmark_fix_t> fixes_;
  bus::Inbox<pose_correction_t> corrections_;
  bus::Inbox<opening_t> openings_;
  bus::Inbox<door_seen_t> leaves_;
  bus::Latest<link_status_t> link_;
  bus::Publisher<landmark_model_t> model_;
  bus::Publisher<look_request_t> look_;
  bus::Publisher<plan_walls_t> walls_;
  bus::Publisher<path_t> path_;
  bus::Publisher<pose_reset_t> place_;
  bus::Publisher<mission_status_t> status_;

  MissionState sent_state_;
  std::size_t sent_changes_ = 0, sent_ends_ = 0;
  RateLimit status_rate_;
  FloorReport floor_;
};

}  // namespace priamos::planner
