#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"

namespace priamos::head {

/// When the head looks again, by itself, at what it found from near: orders come over the radio, too seldom
/// for the last metre.
struct FollowConfig {
  double within_m = 1.1;   ///< what is nearer to the base is followed; 0: nothing is
  double beyond_m = 0.72;  ///< nearer, looks go to what stands beyond it, where that is known; 0: they do not
  double until_m = 0.1;    ///< so far behind the landmark's plane
  double every_s = 0.3;    ///< from one exposure to the next look
  double least_m_s = 0.05;  ///< a base that is slower stands, and waits for orders

  void Describe(Archive& a);
};

/// Where the base is before a landmark that it drives to.
struct Approach {
  double ahead_m = 0;        ///< the plane of the landmark, along the way; negative: behind the base
  double speed_m_s = 0;      ///< of the base
  bool sees_beyond = false;  ///< whether enough is known of what stands beyond the landmark
};

/// What to look at next.
enum class Following { kNothing, kLandmark, kBeyond };

/// Whether a landmark is followed: as long as looks find it, it is near, and the base drives. Once it is too
/// near to be found, what stands beyond it is looked at instead.
class FollowUp {
 public:
  explicit FollowUp(const FollowConfig& config) : config_(config) {}

  /// A look at the landmark was answered. `exposure`: of its pictures.
  void Answered(bool found, Time exposure);
  /// A look at what stands beyond it was answered.
  void AnsweredBeyond(bool found, Time exposure);
  /// What to look at again now; once for each answer. A landmark that is farther away, or before which the
  /// base stands, is not followed until a look that somebody orders has found it again.
  Following Due(const Approach& approach, Time now);
  /// Whether a look at the landmark, also one that somebody orders, had better go to what stands beyond it.
  bool GoesBeyond(const Approach& approach) const;

 private:
  bool IsNear(const Approach& approach) const;

  FollowConfig config_;
  std::optional<Time> answered_;
  bool lost_ = false;  ///< the landmark was not found by the last look
  int missed_ = 0;     ///< looks beyond it in a row that told nothing
};

}  // namespace priamos::head
