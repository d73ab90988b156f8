#include "cli/scenario/stand_confirmation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr double kStill_m_s = 0.03;
// DRIVE_STATUS comes twice a second over the radio and takes 1.35 s at most; a path takes 3.7 s.
constexpr Duration kSilentAfter = std::chrono::seconds(3);
constexpr Duration kConfirmsWithin = std::chrono::seconds(8);

}  // namespace

void StandConfirmation::Hear(const path_t& path) {
  stand_id_ = path.n_points == 0 ? std::optional(path.path_id) : std::nullopt;
}

void StandConfirmation::Hear(const drive_status_t& drive, Time now) {
  drive_ = drive;
  drive_heard_ = now;
}

bool StandConfirmation::Stands(Time since, Time now) const {
  if (!drive_ || drive_heard_ < since || now - drive_heard_ > channels::kDriveStatus.stale_after)
    return false;
  if (drive_->mode == drive_status_t::OPERATED) return true;
  if (drive_->speed_m_s > kStill_m_s) return false;
  return drive_->estop || (stand_id_ == drive_->path_id && drive_->mode != drive_status_t::FOLLOWING);
}

std::string StandConfirmation::How() const {
  if (drive_ && drive_->mode == drive_status_t::OPERATED) return "a person drives the robot by hand";
  if (drive_ && drive_->estop) return "the robot stands, its emergency stop is latched";
  return "the robot stands";
}

bool StandConfirmation::IsOverdue(Time since, Time now) const {
  const Time heard = drive_ ? std::max(drive_heard_, since) : since;
  return now - heard > kSilentAfter || now - since > kConfirmsWithin;
}

std::string StandConfirmation::WhyNot(Time listened, Time now) const {
  const Duration silence = now - (drive_ ? drive_heard_ : listened);
  if (silence > channels::kDriveStatus.stale_after)
    return fmt::format(
        "nothing is heard from the robot for {:.0f} s: it goes on as it was told until the radio is back",
        Seconds(silence));
  return fmt::format("the robot has not confirmed that it stands: it reports {:.2f} m/s; next: priamos where",
                     drive_->speed_m_s);
}

}  // namespace priamos::cli
