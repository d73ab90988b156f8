#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bus/clocks/clock.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/radio/line/line.hpp"
#include "bus/real_time_loop.hpp"
#include "cli/supervise/deployment.hpp"
#include "cli/supervise/link_emulate.hpp"
#include "cli/supervise/supervisor.hpp"
#include "common/random.hpp"
#include "lcmtypes/channels.hpp"
#include "teleop/emulated_mouse.hpp"
#include "test/support/radio/drive_freshness.hpp"

namespace priamos::bench {

/// The line between the radios, in a thread of this process: it can be cut at any moment, and knows which
/// bytes went over it when.
class StudyLine {
 public:
  struct Frame {
    Time end;               ///< when its last byte arrived
    std::size_t bytes = 0;  ///< with its delimiter
  };

  StudyLine(const std::string& onboard_tty, const std::string& offboard_tty,
            const bus::radio::LineConfig& config);
  ~StudyLine();

  /// While it is cut every byte in both directions is lost.
  void Cut(bool cut) { cut_ = cut; }
  /// The newest frame to the robot that had arrived at `at`.
  Frame DownFrameBefore(Time at) const;
  /// What the line itself needs for `frame`.
  Duration WireTime(const Frame& frame) const;

 private:
  void Run();
  void Step(Time now);
  void NoteDown(std::span<const std::byte> bytes, Time now);

  bus::radio::LineConfig config_;
  bus::MonotonicClock clock_;
  cli::PseudoTerminal onboard_, offboard_;
  bus::radio::LinePair lines_;  ///< a: onboard, b: offboard
  std::atomic<bool> cut_{false}, end_{false};
  mutable std::mutex mutex_;
  std::deque<Frame> down_;
  std::size_t bytes_ = 0;  ///< of the frame that is arriving
  std::thread thread_;
};

struct RigOptions {
  std::string source_folder;   ///< of the tree
  std::string program_folder;  ///< where priamos-* are
  std::string run_folder;      ///< absolute, exists
  std::vector<std::string> modules{"world", "robot", "radio", "teleop"};
  bool own_line = true;    ///< else the deployment's own process emulates it
  bool saturated = false;  ///< more is offered to the radio, towards the robot, than it can carry
  /// After so long a process counts as stable and its back-off begins anew; 0: as always.
  Duration stable_after{};
  bool patient = false;  ///< the supervisor lets a stopped process be
  std::uint64_t seed = 1;
};

/// The deployment config/sim on an open field with real processes, the real spacenavd, and an operator's hand
/// at an emulated mouse. Needs a network of its own (scripts/in-private-network).
class DrivingRig {
 public:
  static constexpr std::uint32_t kDeadMan = 1u << 0, kEstopKey = 1u << 2, kRangeKey = 1u << 4,
                                 kRearmKey = 1u << 5;
  static constexpr double kFullSpeed = 6.0;  ///< [rad/s] of the wheels in the fast range: 0.6 m/s

  explicit DrivingRig(const RigOptions& options);
  ~DrivingRig();

  Time Now() const { return clock_.Now(); }
  /// Everything goes on until `done`, at most `most`. Returns whether it came.
  bool Until(const std::function<bool()>& done, Duration most);
  void Wait(double seconds);
  /// Starts everything; throws std::runtime_error with what did not come.
  void Start();

  Stick hand;  ///< what the hand does from now on
  bool mouse_plugged = true;
  bool supervisor_frozen = false;  ///< as if it were stopped: it reads nothing and does nothing
  /// When the mouse last told of a change of the hand.
  Time mouse_spoke() const { return mouse_spoke_; }

  /// Lets go, then holds the dead-man until the lease is there.
  bool Grip();
  /// Pushes forward or back, towards the middle of the field, until the base has the full speed of the fast
  /// range for a while.
  bool DriveAtFullSpeed();
  void LetGo() { hand = {}; }
  void SayEstop(bool stop);
  /// Lifts the e-stop, as an act of the console on the robot's own bus, and waits for the robot to say so.
  bool Rearm();

  /// Pid of a process, 0 while it does not run.
  pid_t Pid(const std::string& name) const;
  bool IsReady(const std::string& name) const;
  int Starts(const std::string& name) const;
  int AllStarts() const;
  std::vector<std::string> Names() const;
  std::string Reason(const std::string& name) const;
  /// What a process was told to do with its range key is forgotten when it starts again.
  void ForgetRange() { fast_ = false; }

  /// Wheel commands, drive commands seen on either bus, since the last Forget.
  std::vector<Seen<wheel_command_t>> wheels;
  std::vector<Seen<drive_command_t>> offboard_commands, onboard_commands;
  std::vector<Seen<lease_request_t>> lease_requests;
  std::vector<Seen<estop_t>> onboard_estops;
  void Forget();
  Seen<drive_status_t> onboard_status, offboard_status;
  Seen<world_truth_t> truth;
  Seen<wheel_state_t> wheel_state;
  Seen<link_status_t> offboard_link;
  Seen<mission_status_t> mission;
  Seen<head_command_t> head_command;
  std::vector<Seen<health_t>> healths;
  /// A wish to turn the head a little, on the robot's own bus.
  void TurnHead();

  /// Mean of the wheels: the part that drives straight on. [rad/s]
  static double Forward(const wheel_command_t& command);

  StudyLine* line() { return line_.get(); }
  Rng rng;

 private:
  std::vector<cli::ProcessSpec> Plan() const;
  void Step();
  void Collect();
  void MoveMouse();
  void Saturate();

  RigOptions options_;
  bus::SignalWatch signals_;
  bus::MonotonicClock clock_;
  bus::Schema schema_;
  cli::Deployment deployment_;
  cli::LaunchPlace place_;
  bus::LcmBus onboard_bus_, offboard_bus_;
  bus::Node onboard_, offboard_;
  bus::Inbox<wheel_command_t> wheel_inbox_;
  bus::Inbox<drive_command_t> onboard_inbox_, offboard_inbox_;
  bus::Inbox<lease_request_t> lease_inbox_;
  bus::Inbox<estop_t> estop_inbox_;
  bus::Inbox<health_t> onboard_health_, offboard_health_;
  bus::Latest<drive_status_t> onboard_status_, offboard_status_;
  bus::Latest<world_truth_t> truth_;
  bus::Latest<wheel_state_t> wheel_state_;
  bus::Latest<link_status_t> offboard_link_;
  bus::Latest<mission_status_t> mission_;
  bus::Latest<head_command_t> head_command_;
  bus::Publisher<estop_t> onboard_estop_, offboard_estop_;
  bus::Publisher<head_drive_t> head_drive_;
  bus::Publisher<health_t> bulk_;
  cli::PseudoTerminal mouse_tty_;
  teleop::EmulatedMouse mouse_;
  Stick told_;
  Time mouse_spoke_{}, next_bulk_{};
  bool fast_ = false;
  int head_wishes_ = 0;
  std::unique_ptr<StudyLine> line_;
  std::unique_ptr<cli::Supervisor> supervisor_;
};

/// Figures of one kind in milliseconds, for a table.
class Sample {
 public:
  void Add(Duration d) { ms_.push_back(1e3 * Seconds(d)); }
  std::size_t size() const { return ms_.size(); }
  double Percentile(double percent) const;
  double Largest() const { return Percentile(100); }
  int Within(double ms) const;

 private:
  std::vector<double> ms_;
};

}  // namespace priamos::bench
