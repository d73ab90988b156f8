#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bus/node.hpp"
#include "cli/scenario/alive_processes.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/serial_port.hpp"
#include "lcmtypes/channels.hpp"
#include "teleop/emulated_mouse.hpp"

namespace priamos::cli {

/// A person at the space-mouse who sees the robot (WORLD_TRUTH stands for his eyes): drives from waypoint to
/// waypoint, or shakes the stick at random, through an emulated mouse.
class TeleopStory : public ScenarioStory {
 public:
  static constexpr std::string_view kName = "teleop";
  static constexpr std::string_view kSummary = "an operator drives";
  static constexpr bool kMovesMouse = true;
  static constexpr bool kSeeksDoor = true;
  static constexpr bool kNeedsPlanner = false, kNeedsWaypoints = false;

  explicit TeleopStory(const StoryStage& stage);

  void Tick(Time now) override;
  bool Done(Time now) const override;
  bool Started() const override { return began_.has_value(); }
  bool Succeeded() const override { return succeeded_; }
  bool DecidesTheRun() const override { return true; }
  std::string Reason() const override;

 private:
  bool Ready() const;
  void Decide(Time now);
  void DriveToWaypoint(Time now);
  void Waver(Time now);
  void Shake(Time now);
  void Finish(Time now, bool succeeded, const std::string& text);
  void MoveMouse(Time now);

  Scenario scenario_;
  std::function<void(Time, const std::string&)> progress_;
  std::unique_ptr<ByteStream> line_;
  teleop::EmulatedMouse mouse_;
  Rng rng_;
  Stick hand_;
  bus::Latest<world_truth_t> truth_;
  AliveProcesses alive_;
  bus::Latest<drive_status_t> status_;
  std::string text_ = "waits for the processes";
  std::size_t waypoint_ = 0;
  std::optional<Time> start_, began_, gripped_, driving_, shake_until_, waver_until_, ended_;
  double astray_rad_ = 0;
  bool rests_ = false;
  bool succeeded_ = false;
};

}  // namespace priamos::cli
