#include "head/core/tracks/tracked_place.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace priamos::head {

double SigmaOf(const Eigen::Matrix2d& covariance) {
  return std::sqrt(covariance.trace());
}

TrackedPlace PlaceOf(const Pose2& base_from_thing, const Eigen::Matrix2d& covariance,
                     const Pose2& map_from_base, const PlaceOptions& options) {
  const Eigen::Matrix2d turn = map_from_base.rotation();
  TrackedPlace place;
  place.map_from_thing = map_from_base * base_from_thing;
  place.covariance =
      turn * covariance * turn.transpose() + options.drift_m * options.drift_m * Eigen::Matrix2d::Identity();
  place.single = place.covariance;
  place.map_from_base = map_from_base;
  return place;
}

void Move(const Pose2& new_from_old, TrackedPlace& place) {
  const Eigen::Matrix2d turn = new_from_old.rotation();
  place.map_from_thing = new_from_old * place.map_from_thing;
  place.map_from_base = new_from_old * place.map_from_base;
  place.covariance = turn * place.covariance * turn.transpose();
  place.single = turn * place.single * turn.transpose();
}

double Fuse(const TrackedPlace& seen, const PlaceOptions& options, TrackedPlace& place) {
  const double driven_m = (seen.map_from_base.translation() - place.map_from_base.translation()).norm();
  const double drift_m = options.drift * driven_m;
  const Eigen::Matrix2d before = place.covariance + drift_m * drift_m * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d off = seen.map_from_thing.translation() - place.map_from_thing.translation();
  const Eigen::Matrix2d both = before + seen.covariance;
  if (off.dot(both.inverse() * off) > options.gate * options.gate) {
    place = seen;
    return 1;
  }
  place.map_from_base = seen.map_from_base;
  const Eigen::Matrix2d gain = before * both.inverse();
  const Eigen::Vector2d at = place.map_from_thing.translation() + gain * off;
  place.map_from_thing.x = at.x();
  place.map_from_thing.y = at.y();
  const double share = SigmaOf(before) / (SigmaOf(before) + SigmaOf(seen.covariance));
  const double turn = WrapAngle(seen.map_from_thing.yaw - place.map_from_thing.yaw);
  if (std::abs(turn) < kPi / 2) place.map_from_thing.yaw = WrapAngle(place.map_from_thing.yaw + share * turn);
  if (SigmaOf(seen.covariance) < SigmaOf(place.single)) place.single = seen.covariance;
  place.covariance = before - gain * before;
  const double least = place.single.trace() / 4 / std::max(1e-12, place.covariance.trace());
  if (least > 1) place.covariance *= least;
  return share;
}

}  // namespace priamos::head
