#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"

namespace priamos::head {

/// When the head looks again, by itself, at what it found from near: orders come over the radio, too seldom
/// for the last metre.
struct FollowConfig {
  double within_m = 1.1;    ///< what is nearer to the base is followed; 0: nothing is
  double every_s = 0.3;     ///< from one exposure to the next look
  double least_m_s = 0.05;  ///< a base that is slower stands, and waits for orders

  void Describe(Archive& a);
};

/// Whether a landmark is followed: as long as looks find it, it is near, and the base drives.
class FollowUp {
 public:
  explicit FollowUp(const FollowConfig& config) : config_(config) {}

  /// A look was answered. `exposure`: of its pictures.
  void Answered(bool found, Time exposure);
  /// Whether to look again now, from `distance_m` at `speed_m_s`. A landmark that is farther away, or before
  /// which the base stands, is not followed until a look that somebody orders has found it again.
  bool Due(double distance_m, double speed_m_s, Time now);

 private:
  FollowConfig config_;
  std::optional<Time> found_;
};

}  // namespace priamos::head
