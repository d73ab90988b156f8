#include "robot/core/motion/corridor_drive.hpp"

namespace priamos::robot {

void CorridorDrive::Begin(const Pose2& odom_from_base, double yaw_rad) {
  looked_at_.reset();
  yield_.End();
  room_m_ = 0;
  guide_.Begin(odom_from_base, yaw_rad);
}

bool CorridorDrive::IsDue(Time now) const {
  return !looked_at_ || now - *looked_at_ >= FromSeconds(config_.realign_s);
}

/// The pose may be wrong, or be corrected on the way: the walls are heard, and lead.
CentredPath CorridorDrive::Centred(const Path& ordered, const Pose2& map_from_base,
                                   const Pose2& odom_from_base, double to_go_m, Time now) {
  looked_at_ = now;
  const Pose2 map_from_odom = map_from_base * odom_from_base.Inverse();
  CentredPath centred = AlongAxis(ordered, guide_.Follow(odom_from_base), map_from_odom, to_go_m,
                                  footprint_.width_m / 2, config_);
  room_m_ = centred.path.leeway.empty() ? 0 : centred.path.leeway.front().right_m;
  return centred;
}

/// Who comes is not evaded on the way: the base goes to the side and lets him pass.
std::optional<Twist2> CorridorDrive::MakeRoom(const MoverWatch& movers, const PathFollower::Wanted& wanted,
                                              const Pose2& odom_from_base, Time now) {
  const auto aside = yield_.Step(ComerAhead(movers, odom_from_base), wanted.cross_track_m, room_m_, now);
  if (!aside) return std::nullopt;
  return Twist2{0, *aside, wanted.heading_error_rad};
}

std::optional<Comer> CorridorDrive::ComerAhead(const MoverWatch& movers, const Pose2& odom_from_base) const {
  const Mover* mover = movers.NearestAhead(odom_from_base);
  if (!mover) return std::nullopt;
  const Eigen::Vector2d at = odom_from_base.Inverse() * mover->at;
  // Who walks past beside the base does not come any more.
  if (at.x() < footprint_.length_m / 2) return std::nullopt;
  return Comer{footprint_.Distance(at), mover->velocity.norm(), at.y()};
}

}  // namespace priamos::robot
