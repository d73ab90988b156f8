#include "common/learned/door_book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace priamos {
namespace {

constexpr double kSameTime_s = 2;  ///< times travel in steps of a second

LearnedDoor* Nearest(const LearnedDoor& told, LearnedWalls& map) {
  LearnedDoor* nearest = nullptr;
  double least_m = kSameDoor_m;
  for (LearnedDoor& door : map.doors) {
    const double away_m = (door.map_from_door().translation() - told.map_from_door().translation()).norm();
    if (away_m > least_m) continue;
    least_m = away_m;
    nearest = &door;
  }
  return nearest;
}

/// A head tells each door again and again.
bool IsRepeated(const LearnedDoor& told, const LearnedDoor& known) {
  const bool same_state = told.state == known.state || told.state == "unknown";
  return same_state && told.looks == known.looks && std::abs(told.seen_s - known.seen_s) < kSameTime_s;
}

int NextId(const LearnedWalls& map) {
  int last = 0;
  for (const LearnedDoor& door : map.doors) last = std::max(last, door.id);
  return last + 1;
}

}  // namespace

bool EnterDoor(const LearnedDoor& told, LearnedWalls& map) {
  LearnedDoor* door = Nearest(told, map);
  if (!door) {
    map.doors.push_back(told);
    map.doors.back().id = NextId(map);
    ++map.revision;
    return true;
  }
  if (told.seen_s < door->seen_s - kSameTime_s || IsRepeated(told, *door)) return false;
  LearnedDoor now = told;
  now.id = door->id;
  now.changed_s = door->changed_s;
  if (now.state == "unknown") {  // a look that shows nothing of the leaf changes nothing
    now.state = door->state;
    now.state_log_odds = door->state_log_odds;
  }
  if (now.state != door->state && door->state != "unknown") now.changed_s = told.seen_s;
  *door = now;
  ++map.revision;
  return true;
}

std::string DoorsSeenSince(const LearnedWalls& map, double since_s) {
  std::map<std::string, int> states;
  int n = 0;
  for (const LearnedDoor& door : map.doors) {
    if (door.seen_s < since_s) continue;
    ++states[door.state];
    ++n;
  }
  if (n == 0) return "";
  std::string words = fmt::format("{} door{} on the way", n, n == 1 ? "" : "s");
  const char* before = ": ";
  for (const auto& [state, count] : states) {
    words += fmt::format("{}{} {}", before, count, state);
    before = ", ";
  }
  return words;
}

}  // namespace priamos
