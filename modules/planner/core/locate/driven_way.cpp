#include "planner/core/locate/driven_way.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

constexpr double kSpot_m = 0.15;  ///< between two places of the trail
constexpr double kSpot_rad = 0.2;
/// FEATURES say in whole seconds when a wall was heard last.
constexpr double kSeenStep_s = 1;

double Seconds1970(Time time) {
  return static_cast<double>(ToUtime(time)) * 1e-6;
}

/// Whether two pieces show the same wall twice.
bool AreOne(const HeardPiece& a, const HeardPiece& b) {
  constexpr double kTurned_rad = 0.15, kAcross_m = 0.15;
  const Pose2 offset = a.way_from_middle.Inverse() * b.way_from_middle;
  return std::abs(offset.yaw) < kTurned_rad && std::abs(offset.y) < kAcross_m &&
         std::abs(offset.x) < (a.length_m + b.length_m) / 2;
}

}  // namespace

Eigen::Vector2d HeardPiece::NearestTo(const Eigen::Vector2d& place) const {
  const double along_m = (way_from_middle.Inverse() * place).x();
  return At(std::clamp(along_m, -length_m / 2, length_m / 2));
}

void WayLog::Begin(Time now) {
  *this = {};
  newest_ = now;
  not_before_s_ = Seconds1970(now);
}

void WayLog::OnPose(Time stamp, const Pose2& told_from_base, std::optional<Time> corrected) {
  if (stamp <= newest_) return;
  const bool jumps = corrected && corrected != corrected_;
  if (jumps && stamp <= *corrected) return;  // neither the old frame nor the new one for certain
  newest_ = stamp;
  if (spots_.empty()) {
    way_from_base_ = told_from_base;
    if (jumps) {
      corrected_ = corrected;
      not_before_s_ = std::max(not_before_s_, Seconds1970(*corrected));
    }
  } else if (jumps) {
    corrected_ = corrected;
    not_before_s_ = Seconds1970(*corrected);
    way_from_told_ = way_from_base_ * told_from_base.Inverse();
  }
  const Pose2 before = way_from_base_;
  way_from_base_ = way_from_told_ * told_from_base;
  driven_m_ += (way_from_base_.translation() - before.translation()).norm();
  const bool moved =
      spots_.empty() ||
      (way_from_base_.translation() - spots_.back().way_from_base.translation()).norm() >= kSpot_m ||
      std::abs(WrapAngle(way_from_base_.yaw - spots_.back().way_from_base.yaw)) >= kSpot_rad;
  if (moved) spots_.push_back({stamp, way_from_base_, driven_m_});
}

/// Where the base was at that time, or a little before.
const WayLog::Spot& WayLog::SpotAt(double utc_s) const {
  const auto after = std::find_if(spots_.begin() + 1, spots_.end(),
                                  [&](const Spot& spot) { return Seconds1970(spot.stamp) > utc_s; });
  return *(after - 1);
}

void WayLog::OnFeature(const SeenFeature& seen) {
  const LearnedWall* wall = seen.wall();
  if (!wall || spots_.empty()) {
    revision_ += pieces_.erase(seen.name());
    return;
  }
  if (wall->seen_s < not_before_s_ + kSeenStep_s) return;
  const Spot& spot = SpotAt(wall->seen_s);
  pieces_[seen.name()] = {way_from_told_ * wall->map_from_wall(), wall->length_m,
                          spot.way_from_base.translation(), spot.at_m};
  ++revision_;
}

DrivenWay WayLog::way() const {
  DrivenWay way;
  way.driven_m = driven_m_;
  for (const Spot& spot : spots_) way.trail.push_back(spot.way_from_base);
  way.trail.push_back(way_from_base_);
  std::vector<HeardPiece> pieces;
  for (const auto& [name, piece] : pieces_) pieces.push_back(piece);
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const HeardPiece& a, const HeardPiece& b) { return a.length_m > b.length_m; });
  for (const HeardPiece& piece : pieces)
    if (std::none_of(way.pieces.begin(), way.pieces.end(),
                     [&](const HeardPiece& longer) { return AreOne(longer, piece); }))
      way.pieces.push_back(piece);
  return way;
}

}  // namespace priamos::planner
