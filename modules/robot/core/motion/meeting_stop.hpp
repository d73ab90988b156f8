#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// When a base stands for who is about to meet it.
struct MeetingStopConfig {
  double within_s = 1.5;   ///< so long before they would meet it stands; 0: it does not
  double patience_s = 4;   ///< and for so long in a row at most ...
  double not_again_s = 2;  ///< ... after which it drives for so long, whoever comes

  void Describe(Archive& a);
};

/// Has the base stand while somebody is about to walk into it, wherever he comes from: who does not look
/// walks into a base that stands. Not for ever: what sonars take for somebody may be something that the base
/// passes.
class MeetingStop {
 public:
  explicit MeetingStop(const MeetingStopConfig& config) : config_(config) {}

  double within_s() const { return config_.within_s; }
  /// Whether the base stands now. `about_to_meet`: somebody will meet it in less than `within_s`.
  bool Stands(bool about_to_meet, Time now);

 private:
  MeetingStopConfig config_;
  std::optional<Time> since_, gone_on_;  ///< since when it stands; when its patience ended
};

}  // namespace priamos::robot
