#include "planner/core/map/point_book.hpp"

#include <algorithm>
#include <set>

namespace priamos::planner {
namespace {

auto Find(int id, std::vector<LearnedPoint>& points) {
  return std::find_if(points.begin(), points.end(), [id](const LearnedPoint& p) { return p.id == id; });
}

}  // namespace

void PointBook::Take(const FeatureName& name, const LearnedPoint& told, std::vector<LearnedPoint>& points) {
  const auto known = ids_.find(name);
  const auto point = known == ids_.end() ? points.end() : Find(known->second, points);
  const bool elsewhere = point != points.end() && (point->at() - told.at()).norm() > kSamePoint_m;
  if (point == points.end() || (elsewhere && IsShared(point->id))) {
    // Of several that were taken for one the others stay where they are.
    ids_[name] = EnterPoint(told, points);
  } else {
    const int id = point->id;
    *point = told;
    point->id = id;
    Join(id, points);
  }
  if (points.size() == kMostPoints) ForgetDropped(points);
}

/// What had to go for lack of room has no names.
void PointBook::ForgetDropped(const std::vector<LearnedPoint>& points) {
  std::set<int> there;
  for (const LearnedPoint& point : points) there.insert(point.id);
  std::erase_if(ids_, [&](const auto& entry) { return !there.contains(entry.second); });
}

bool PointBook::Forget(const FeatureName& name, std::vector<LearnedPoint>& points) {
  const auto known = ids_.find(name);
  if (known == ids_.end()) return false;
  const int id = known->second;
  std::erase_if(ids_, [id](const auto& entry) { return entry.second == id; });
  return std::erase_if(points, [id](const LearnedPoint& p) { return p.id == id; }) > 0;
}

bool PointBook::IsShared(int id) const {
  return std::count_if(ids_.begin(), ids_.end(), [id](const auto& entry) { return entry.second == id; }) > 1;
}

/// A point that was moved takes in what lies there: the older number stays.
void PointBook::Join(int id, std::vector<LearnedPoint>& points) {
  LearnedPoint moved = *Find(id, points);
  const auto other = std::find_if(points.begin(), points.end(), [&](const LearnedPoint& p) {
    return p.id != id && (p.at() - moved.at()).norm() <= kSamePoint_m;
  });
  if (other == points.end()) return;
  const int kept = std::min(id, other->id), gone = std::max(id, other->id);
  for (auto& [name, of] : ids_)
    if (of == gone) of = kept;
  moved.id = kept;
  *Find(kept, points) = moved;
  points.erase(Find(gone, points));
}

}  // namespace priamos::planner
