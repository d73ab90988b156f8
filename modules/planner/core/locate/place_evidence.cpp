#include "planner/core/locate/place_evidence.hpp"

#include <algorithm>

namespace priamos::planner {
namespace {

/// Walls count again for what was driven without any.
constexpr double kSearchAgain_m = 1;
/// Nearer to the middle of the base, on its way, no wall is: less than half its width.
constexpr double kDrivenOver_m = 0.3;
constexpr double kSigma_m = 0.03;

bool IsDrivenOver(const HeardPiece& piece, const std::vector<Pose2>& trail) {
  return std::any_of(trail.begin(), trail.end(), [&](const Pose2& spot) {
    return (piece.NearestTo(spot.translation()) - spot.translation()).norm() < kDrivenOver_m;
  });
}

}  // namespace

void PlaceEvidence::Begin(Time now) {
  log_.Begin(now);
  met_.Reset();
  searched_ = 0;
  searched_at_m_ = 0;
  found_.clear();
  changed_ = {};
}

void PlaceEvidence::OnFeature(const SeenFeature& seen, Time now) {
  const std::size_t before = log_.revision();
  log_.OnFeature(seen);
  if (log_.revision() != before) changed_ = now;
}

const std::vector<PlaceCandidate>& PlaceEvidence::Search() {
  const bool same = searched_ == log_.revision() && log_.driven_m() < searched_at_m_ + kSearchAgain_m;
  if (same || log_.empty()) return found_;
  searched_ = log_.revision();
  searched_at_m_ = log_.driven_m();
  found_ = FindPlaces(config_, plan_, log_.way());
  return found_;
}

std::vector<PlaceCandidate> PlaceEvidence::SearchWithin(double margin) const {
  PlaceSearchConfig config = config_;
  config.margin = margin;
  return FindPlaces(config, plan_, log_.way());
}

std::vector<PlaceCandidate> PlaceEvidence::Rivals(double lead) const {
  std::vector<PlaceCandidate> rivals;
  for (const PlaceCandidate& c : found_)
    if (c.score >= found_.front().score - lead) rivals.push_back(c);
  return rivals;
}

int PlaceEvidence::CountHeld() const {
  return static_cast<int>(
      std::count_if(found_.begin(), found_.end(), [](const PlaceCandidate& c) { return c.IsHeld(); }));
}

LearnedWalls WallsAt(const DrivenWay& way, const Pose2& map_from_way) {
  LearnedWalls learned;
  for (const HeardPiece& piece : way.pieces) {
    if (IsDrivenOver(piece, way.trail)) continue;
    const Pose2 at = map_from_way * piece.way_from_middle;
    LearnedWall wall;
    wall.id = static_cast<int>(learned.walls.size()) + 1;
    wall.x_m = at.x;
    wall.y_m = at.y;
    wall.yaw_deg = Degrees(at.yaw);
    wall.length_m = piece.length_m;
    wall.sigma_across_m = kSigma_m;
    learned.walls.push_back(wall);
  }
  return learned;
}

}  // namespace priamos::planner
