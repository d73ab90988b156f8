#include "robot/core/sonar/arc_votes.hpp"

#include <cmath>

namespace priamos::robot {
namespace {

using Eigen::Vector2d;

constexpr double kVoteCell_m = 0.1;
/// What echoes to all sides is heard so far off the axis of a sensor, and places on an arc are so far apart.
constexpr double kArcHalf_rad = Radians(12), kPlacesApart_m = 0.08;

/// Calls `visit(place)` for places all along the arc of an echo.
template <class Visit>
void ForEachPlace(const PlacedEcho& echo, const Visit& visit) {
  const int half = static_cast<int>(std::ceil(kArcHalf_rad * echo.range_m / kPlacesApart_m));
  for (int i = -half; i <= half; ++i) {
    const double angle = echo.odom_from_sonar.yaw + kArcHalf_rad * i / half;
    visit(echo.Foot({std::cos(angle), std::sin(angle)}));
  }
}

}  // namespace

ArcVotes::ArcVotes() : cells_(std::size_t(kSide) * kSide) {}

std::size_t ArcVotes::IndexOf(const Vector2d& place) {
  const auto wrapped = [](double m) {
    const double cell = std::floor(m / kVoteCell_m);
    return static_cast<std::size_t>(cell - kSide * std::floor(cell / kSide));
  };
  return wrapped(place.y()) * kSide + wrapped(place.x());
}

/// A cell has one vote of an echo at most: two places of its arc that follow each other may share it.
void ArcVotes::Vote(const PlacedEcho& echo, int change) {
  std::size_t last = cells_.size();
  ForEachPlace(echo, [&](const Vector2d& place) {
    const std::size_t index = IndexOf(place);
    if (index != last) cells_[index] = static_cast<std::int16_t>(cells_[index] + change);
    last = index;
  });
}

/// Of the cell and the four that share a side with it: an arc on a border votes for either.
int ArcVotes::Around(const Vector2d& place) const {
  int votes = cells_[IndexOf(place)];
  for (const double off_m : {-kVoteCell_m, kVoteCell_m})
    votes += cells_[IndexOf(place + Vector2d(off_m, 0))] + cells_[IndexOf(place + Vector2d(0, off_m))];
  return votes;
}

VotedPlace ArcVotes::Best(const PlacedEcho& echo) const {
  VotedPlace best;
  ForEachPlace(echo, [&](const Vector2d& place) {
    const int votes = Around(place);
    if (votes > best.votes) best = {place, votes};
  });
  return best;
}

}  // namespace priamos::robot
