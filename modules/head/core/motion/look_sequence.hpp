#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/robot/camera_bits.hpp"
#include "common/time.hpp"
#include "head/core/camera/frame_notice.hpp"

namespace priamos::head {

/// Waiting times and attempts of one look.
struct LookConfig {
  double frame_timeout_s = 0.5;  ///< time after which missing pictures are exposed again
  int attempts = 3;              ///< exposures per look
  double age_limit_s = 12;       ///< time after which a look is given up
  double near_m = 1.8;           ///< looks at what is nearer leave no time for glances

  void Describe(Archive& a);
};

/// State machine of one look: the head settles, its cameras are exposed at the same time, all pictures
/// arrive. It always ends, with pictures or without. A third picture that does not come in time is done
/// without.
class LookSequence {
 public:
  static constexpr int kPair = 2;  ///< left and right: what a look needs

  /// Who decides which pictures a look uses: this sequence, by what it has exposed itself, or the log that is
  /// played, by the pictures that it was recorded with. Then nothing is exposed, and where the head points
  /// now does not matter.
  enum class Exposures { kOwn, kRecorded };

  /// Sequence without a look. `cameras` is 2 for the stereo pair, 3 for all.
  explicit LookSequence(const LookConfig& config, int cameras = kPair, Exposures exposures = Exposures::kOwn)
      : config_(config), cameras_(cameras), wanted_(cameras), exposures_(exposures) {}

  /// Changes times and attempts, also of the look under way.
  void set_config(const LookConfig& config) { config_ = config; }
  void Begin(Time now) { Begin(now, cameras_); }
  /// A look of the first `cameras` cameras.
  void Begin(Time now, int cameras);
  bool active() const { return phase_ != Phase::kIdle; }
  void End() { phase_ = Phase::kIdle; }

  void Add(const FrameNotice& frame);

  /// What to do now.
  enum class Action { kWait, kTrigger, kUseFrames, kGiveUp };
  /// One time step. `head_failed` gives the look up; kTrigger: expose the cameras as frame_id(). If the head
  /// moves during the exposure the pictures are exposed again.
  Action Step(bool head_settled, bool head_failed, Time now);

  std::int32_t frame_id() const { return frame_id_; }
  /// When its cameras were exposed last.
  Time exposed_at() const { return triggered_; }
  /// Bits of the cameras to expose.
  int camera_mask() const { return CameraBits(wanted_); }
  /// The pictures, after kUseFrames: left, right, and the third one if it came.
  Frames frames() const;

 private:
  enum class Phase { kIdle, kSettling, kExposing };
  bool HasFirst(int cameras) const;
  Action StepOnLog(Time now) const;
  LookConfig config_;
  int cameras_, wanted_;
  Exposures exposures_;
  Phase phase_ = Phase::kIdle;
  Time begun_{}, triggered_{};
  int attempts_ = 0;
  std::int32_t frame_id_ = 0;
  std::array<std::optional<FrameNotice>, 3> frames_;
};

}  // namespace priamos::head
