#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/time.hpp"
#include "priamos/drive_status_t.hpp"
#include "priamos/path_t.hpp"

namespace priamos::cli {

/// Whether the robot does what an abort or a pause has the planner order: to stand. Judged by what is heard
/// at the workstation: the planner's PATH without points, and the robot's DRIVE_STATUS that confirms its
/// number. Times are those of arrival. Pure.
class StandConfirmation {
 public:
  void Hear(const path_t& path);
  void Hear(const drive_status_t& drive, Time now);

  /// The robot has confirmed the order to stand, its emergency stop is latched, or a person drives it by
  /// hand; heard after `since`, and not long before `now`.
  bool Stands(Time since, Time now) const;
  /// How it stands, in words.
  std::string How() const;

  /// Waited long enough: silence from the robot, or reports that do not confirm it, since `since`.
  bool IsOverdue(Time since, Time now) const;
  /// What the robot does instead as far as is known, in words. `listened` since: for a robot that was never
  /// heard.
  std::string WhyNot(Time listened, Time now) const;

 private:
  std::optional<std::int32_t>
      stand_id_;  ///< of the order to stand; none while the newest path leads somewhere
  std::optional<drive_status_t> drive_;
  Time drive_heard_{};
};

}  // namespace priamos::cli
