#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/config.hpp"
#include "common/time.hpp"

namespace priamos::head {

struct LookConfig {
  double frame_timeout_s = 0.5;  ///< both pictures must have come by then, or they are asked for again
  int attempts = 3;              ///< exposures per look
  double age_limit_s = 12;       ///< a look not answered by then is given up

  void Describe(Archive& a);
};

/// A picture that lies ready in the frame store.
struct FrameNotice {
  Time exposure;
  std::int32_t frame_id = 0;
  int camera = 0;  ///< 0 left, 1 right
  int slot = 0;
  int width = 0, height = 0;
};

/// One stereo pair.
using FramePair = std::array<FrameNotice, 2>;

/// The course of one look: the head settles, both cameras are exposed at once, both pictures arrive. Every
/// look ends, with a pair or without.
class LookSequence {
 public:
  explicit LookSequence(const LookConfig& config) : config_(config) {}

  void Begin(Time now);
  bool active() const { return phase_ != Phase::kIdle; }
  void End() { phase_ = Phase::kIdle; }

  void Add(const FrameNotice& frame);

  /// What to do now.
  enum class Action { kWait, kTrigger, kUsePair, kGiveUp };
  /// `head_failed` gives up; kTrigger means: expose both cameras as frame_id(). A head that moves during the
  /// exposure spoils the pair: it is exposed again.
  Action Step(bool head_settled, bool head_failed, Time now);

  std::int32_t frame_id() const { return frame_id_; }
  FramePair pair() const { return {*frames_[0], *frames_[1]}; }

 private:
  enum class Phase { kIdle, kSettling, kExposing };
  LookConfig config_;
  Phase phase_ = Phase::kIdle;
  Time begun_{}, triggered_{};
  int attempts_ = 0;
  std::int32_t frame_id_ = 0;
  std::array<std::optional<FrameNotice>, 2> frames_;
};

}  // namespace priamos::head
