#include "planner/core/map/learned_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/learned/door_book.hpp"
#include "planner/core/map/wall_union.hpp"

namespace priamos::planner {

void LearnedMapConfig::Describe(Archive& a) {
  a.Number("gate", gate, {"-", 0.5, 10, "Mahalanobis distance up to which two walls may be one"});
  a.Number("across_m", across_m, {"m", 0.01, 2, "largest distance of two walls that are one"});
  a.Number("turned_deg", turned_deg, {"deg", 0.5, 45, "largest angle between them"});
  a.Number("gap_m", gap_m, {"m", 0, 5, "largest gap between them, along them"});
  a.Number("most_length_m", most_length_m, {"m", 1, 100, "largest length of a wall that is put together"});
  a.Integer("most", most, {"-", 10, 100000, "walls that are kept"});
}

LearnedMap::LearnedMap(const LearnedMapConfig& config, LearnedWalls known)
    : config_(config), walls_(std::move(known)) {
  NoteOlder();
}

/// What is known of before has no names.
void LearnedMap::NoteOlder() {
  for (const LearnedWall& wall : walls_.walls) {
    last_id_ = std::max(last_id_, wall.id);
    older_.insert(wall.id);
  }
}

void LearnedMap::Replace(LearnedWalls walls) {
  walls.doors = std::move(walls_.doors);
  if (walls.objects.empty()) walls.objects = std::move(walls_.objects);
  Reset();
  walls.revision = walls_.revision;
  walls_ = std::move(walls);
  NoteOlder();
}

LearnedWall* LearnedMap::Find(int id) {
  const auto found = std::find_if(walls_.walls.begin(), walls_.walls.end(),
                                  [id](const LearnedWall& wall) { return wall.id == id; });
  return found == walls_.walls.end() ? nullptr : &*found;
}

bool LearnedMap::Take(const SeenFeature& seen) {
  if (seen.gone()) {
    if (!Forget(seen.name())) return false;
  } else if (const LearnedWall* wall = seen.wall()) {
    points_.Forget(seen.name(), walls_.points);
    TakeWall(seen.name(), *wall);
  } else {
    Leave(seen.name());
    points_.Take(seen.name(), *seen.point(), walls_.points);
  }
  ++walls_.revision;
  return true;
}

/// What was seen through is none, whatever else it was told under. Returns whether there was any.
bool LearnedMap::Forget(const FeatureName& name) {
  const auto known = ids_.find(name);
  if (known == ids_.end()) return points_.Forget(name, walls_.points);
  Remove(known->second);
  return true;
}

void LearnedMap::TakeWall(const FeatureName& name, const LearnedWall& told) {
  const auto known = ids_.find(name);
  if (known == ids_.end()) {
    Consolidate(Begin(name, told).id);
  } else {
    LearnedWall& wall = *Find(known->second);
    LearnedWall next = told;
    next.id = wall.id;
    next.sightings = wall.sightings + 1;
    const bool alone = names_[wall.id].size() == 1 && !older_.contains(wall.id);
    if (alone) {
      wall = next;
    } else if (AreOne(wall, next)) {
      next.sightings = 1;
      wall = UnionOf(wall, next);
    } else {
      Leave(name);
      Consolidate(Begin(name, told).id);
    }
    if (const auto id = ids_.find(name); id != ids_.end()) Consolidate(id->second);
  }
  MakeRoom();
}

/// What has this name is not where it was, or no wall: the rest of the wall that it is part of stays.
void LearnedMap::Leave(const FeatureName& name) {
  const auto known = ids_.find(name);
  if (known == ids_.end()) return;
  const int id = known->second;
  if (names_[id].size() == 1 && !older_.contains(id)) return Remove(id);
  names_[id].erase(name);
  older_.insert(id);
  ids_.erase(known);
}

bool LearnedMap::Take(const LearnedDoor& told) {
  if (!EnterDoor(told, walls_)) return false;
  if (walls_.doors.size() > static_cast<std::size_t>(config_.most))
    walls_.doors.erase(std::min_element(walls_.doors.begin(), walls_.doors.end(),
                                        [](const auto& a, const auto& b) { return a.seen_s < b.seen_s; }));
  return true;
}

LearnedWall& LearnedMap::Begin(const FeatureName& name, const LearnedWall& told) {
  LearnedWall wall = told;
  wall.id = ++last_id_;
  wall.sightings = 1;
  ids_[name] = wall.id;
  names_[wall.id] = {name};
  walls_.walls.push_back(wall);
  return walls_.walls.back();
}

/// Puts a wall together with every other that is one with it; the older number stays.
void LearnedMap::Consolidate(int id) {
  for (;;) {
    const LearnedWall* own = Find(id);
    const auto other = std::find_if(walls_.walls.begin(), walls_.walls.end(), [&](const LearnedWall& wall) {
      return wall.id != id && AreOne(*own, wall);
    });
    if (other == walls_.walls.end()) return;
    const int kept = std::min(id, other->id), gone = std::max(id, other->id);
    *Find(kept) = UnionOf(*Find(kept), *Find(gone));
    for (const FeatureName& name : names_[gone]) ids_[name] = kept;
    names_[kept].merge(names_[gone]);
    if (older_.contains(gone)) older_.insert(kept);
    names_.erase(gone);
    older_.erase(gone);
    std::erase_if(walls_.walls, [gone](const LearnedWall& wall) { return wall.id == gone; });
    id = kept;
  }
}

void LearnedMap::Remove(int id) {
  for (const FeatureName& name : names_[id]) ids_.erase(name);
  names_.erase(id);
  older_.erase(id);
  std::erase_if(walls_.walls, [id](const LearnedWall& wall) { return wall.id == id; });
}

void LearnedMap::MakeRoom() {
  while (walls_.walls.size() > static_cast<std::size_t>(config_.most)) {
    const auto oldest = std::min_element(walls_.walls.begin(), walls_.walls.end(),
                                         [](const auto& a, const auto& b) { return a.seen_s < b.seen_s; });
    Remove(oldest->id);
  }
}

void LearnedMap::Reset() {
  const int revision = walls_.revision + 1;
  walls_ = {};
  walls_.revision = revision;
  ids_.clear();
  names_.clear();
  older_.clear();
  points_.Clear();
}

bool LearnedMap::AreOne(const LearnedWall& a, const LearnedWall& b) const {
  // The middles of walls that touch are no farther apart than half of both: most pairs end here.
  const double apart_m = std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
  if (apart_m > (a.length_m + b.length_m) / 2 + config_.gap_m + config_.across_m) return false;
  if (std::abs(WrapAngle(Radians(a.yaw_deg - b.yaw_deg))) > Radians(config_.turned_deg)) return false;
  const WallOffset offset = OffsetOf(a, b);
  // Written so that NaN is refused.
  return offset.distance <= config_.gate && std::abs(offset.across_m) <= config_.across_m &&
         offset.gap_m <= config_.gap_m && a.length_m + b.length_m + offset.gap_m <= config_.most_length_m;
}

}  // namespace priamos::planner
