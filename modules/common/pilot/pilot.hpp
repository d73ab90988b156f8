#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "common/pilot/pilot_config.hpp"
#include "common/pilot/stick.hpp"
#include "common/pilot/stop_keeper.hpp"
#include "common/pilot/wish_sender.hpp"
#include "common/time.hpp"

namespace priamos {

/// The part of the robot's last status that the pilot needs.
struct RobotView {
  /// Holder of the lease, as seen by this operator.
  enum class Lease { kFree, kMine, kOther };
  std::optional<Time> heard{};  ///< time of that status, in this process's clock
  Lease lease = Lease::kFree;
  bool estop = false;
  int refused = 0;              ///< commands that it refused so far
  bool refuses_motion = false;  ///< the newest of them because the stick must be let go first
};

/// A wish for the motion of the head, as in head_drive_t.
struct HeadRates {
  double pan_rad_s = 0, tilt_rad_s = 0, vergence_rad_s = 0, zoom_step_s = 0, focus_step_s = 0;
  bool operator==(const HeadRates&) const = default;
};

/// What the stick moves.
enum class PilotMode { kBase, kHead };

/// Why the stick does or does not move the robot.
enum class PilotPhase {
  kNoDevice,   ///< no input device
  kIdle,       ///< the dead-man is not held
  kMustLetGo,  ///< it was held when something ended the drive: let go of it first
  kAsking,     ///< it is held; the robot has not yet granted the lease
  kDriving,
};

/// The messages to send now.
struct PilotOutput {
  /// How the lease is asked for: a free one, or also one that somebody holds.
  enum class Lease { kAcquire, kTakeOver };
  /// What is done to the emergency stop.
  enum class Estop { kRearm, kStop };
  std::optional<Twist2> drive{};
  std::optional<HeadRates> head{};
  std::optional<Lease> lease{};
  std::optional<Estop> estop{};
};

/// Turns a stick and buttons into wishes. Pure: time is an argument.
///
/// Nothing moves unless the dead-man is held, the stick reports, and the robot reports that the lease is ours
/// and no e-stop is latched. Pressing the dead-man asks for a free lease; taking a held one needs the
/// take-over button. While it asks, it sends commands to stand, which the robot must receive first. When the
/// drive ends for any reason but the stick at rest, the dead-man must be let go and pressed again. After its
/// end the robot is told to stand until it shows that it lives: what is pressed next must not be refused for
/// a rest that never reached it.
class Pilot {
 public:
  explicit Pilot(const PilotConfig& config);

  PilotOutput Step(const Stick& stick, const RobotView& robot, Time now);

  PilotPhase phase() const { return phase_; }
  PilotMode mode() const { return mode_; }
  bool fast() const { return fast_; }
  /// The wish of the stick, whether it may be sent or not.
  const Twist2& wish() const { return wish_; }
  const HeadRates& head_wish() const { return head_wish_; }

 private:
  bool Pressed(const Stick& stick, int button) const;
  bool LeaseIsOurs(const RobotView& robot, Time now) const;
  void UseButtons(const Stick& stick, const RobotView& robot, Time now, PilotOutput& output);
  void UseEstopButtons(const Stick& stick, const RobotView& robot, Time now, PilotOutput& output);
  PilotPhase NextPhase(const Stick& stick, const RobotView& robot, Time now);
  bool WasRefused(const RobotView& robot);
  void Ask(Time now, PilotOutput& output);
  void Wish(const Stick& stick);
  bool AtRest(const Stick& stick) const;
  bool EndIsUnheard(const RobotView& robot, Time now) const;
  void Send(const Stick& stick, const RobotView& robot, Time now, PilotOutput& output);
  bool Jumped() const;

  PilotConfig config_;
  PilotPhase phase_ = PilotPhase::kNoDevice;
  PilotMode mode_ = PilotMode::kBase;
  bool fast_ = false;
  Twist2 wish_, sent_;
  HeadRates head_wish_;
  Stick before_;
  WishSender base_sender_, head_sender_;
  StopKeeper stop_;
  std::optional<Time> asked_, asked_again_, rearm_since_;
  std::optional<Time> ended_;   ///< end of the last drive
  std::optional<int> refused_;  ///< RobotView::refused of the step before
};

}  // namespace priamos
