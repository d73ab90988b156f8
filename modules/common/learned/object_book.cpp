#include "common/learned/object_book.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos {
namespace {

constexpr double kSameMoment_s = 2;    ///< times travel in steps of a second
constexpr double kSamePlace_m = 0.02;  ///< places travel in steps of a centimetre
constexpr double kNearFront_m = 0.3;   ///< fronts whose middles are nearer are one ...
constexpr double kParallel_deg = 30;   ///< ... when their sides are parallel within this
constexpr double kInside_m = 0.05;     ///< what is known of a footprint's border
constexpr double kAbove_m = 0.3;       ///< what begins so far above the top of the other is another thing
constexpr double kForgotten_s = 600;   ///< what was not seen for so long gives way to what tells less

double Away(const LearnedObject& a, const LearnedObject& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// A box has four sides: which of them is its front depends on where the robot was.
bool AreParallel(const LearnedObject& a, const LearnedObject& b) {
  const double quarter = std::remainder(a.yaw_deg - b.yaw_deg, 90.0);
  return std::abs(quarter) <= kParallel_deg;
}

bool IsInside(const LearnedObject& a, const LearnedObject& b) {
  return Distance(b.Footprint(), a.Footprint().map_from_centre.translation()) <= kInside_m;
}

int RankOf(const LearnedObject& object) {
  return object.kind == "box" ? 2 : object.kind == "face" ? 1 : 0;
}

bool TellsLess(const LearnedObject& told, const LearnedObject& known) {
  const int rank = RankOf(told), other = RankOf(known);
  return rank != other ? rank < other : told.looks < known.looks;
}

/// Whether no look showed more of it since.
bool IsOfSameLooks(const LearnedObject& told, const LearnedObject& known) {
  return told.kind == known.kind && told.looks == known.looks &&
         std::abs(told.seen_s - known.seen_s) < kSameMoment_s;
}

/// A head tells each thing again and again.
bool IsToldAgain(const LearnedObject& told, const LearnedObject& known) {
  return IsOfSameLooks(told, known) && Away(told, known) < kSamePlace_m;
}

bool GivesWay(const LearnedObject& known, const LearnedObject& told) {
  const double younger_s = told.seen_s - known.seen_s;
  if (younger_s < -kSameMoment_s || IsToldAgain(told, known)) return false;
  return !TellsLess(told, known) || younger_s > kForgotten_s;
}

int NextObjectId(const LearnedWalls& map) {
  int last = 0;
  for (const LearnedObject& object : map.objects) last = std::max(last, object.id);
  return last + 1;
}

void MakeRoom(std::vector<LearnedObject>& objects) {
  while (objects.size() > kMostObjects)
    objects.erase(std::min_element(objects.begin(), objects.end(),
                                   [](const auto& a, const auto& b) { return a.seen_s < b.seen_s; }));
}

/// What was seen there later remains.
bool TakeAway(const LearnedObject& gone, LearnedWalls& map) {
  const auto erased = std::erase_if(map.objects, [&](const LearnedObject& known) {
    return AreOne(gone, known) && known.seen_s < gone.seen_s + kSameMoment_s;
  });
  if (erased > 0) ++map.revision;
  return erased > 0;
}

/// Whether a head tells here what it told there before.
bool HasMoved(const LearnedObject& told, const LearnedObject& known) {
  if (told.told_id < 0 || told.told_id != known.told_id || TellsLess(told, known)) return false;
  const double younger_s = told.seen_s - known.seen_s;
  const bool goes_on = told.looks > known.looks && younger_s >= 0 && younger_s < kForgotten_s;
  return goes_on || IsOfSameLooks(told, known);
}

}  // namespace

bool AreOne(const LearnedObject& a, const LearnedObject& b) {
  if (a.bottom_m > b.top_m + kAbove_m || b.bottom_m > a.top_m + kAbove_m) return false;
  return IsInside(a, b) || IsInside(b, a) || (Away(a, b) < kNearFront_m && AreParallel(a, b));
}

bool EnterObject(const LearnedObject& told, LearnedWalls& map) {
  if (told.looks == 0) return TakeAway(told, map);
  LearnedObject now = told;
  now.id = NextObjectId(map);
  double least_m = std::numeric_limits<double>::infinity();
  for (const LearnedObject& known : map.objects) {
    if (!AreOne(told, known)) continue;
    if (!GivesWay(known, told)) return false;
    if (Away(told, known) >= least_m) continue;
    least_m = Away(told, known);
    now.id = known.id;
  }
  std::erase_if(map.objects,
                [&](const LearnedObject& known) { return AreOne(told, known) || HasMoved(told, known); });
  map.objects.push_back(now);
  MakeRoom(map.objects);
  ++map.revision;
  return true;
}

}  // namespace priamos
