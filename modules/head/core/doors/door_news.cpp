#include "head/core/doors/door_news.hpp"

#include <tuple>

namespace priamos::head {

bool DoorNews::IsNews(const DoorTracks& doors, const DoorTrack& track) const {
  const auto told = told_.find(track.id);
  return told == told_.end() || told->second.state != doors.StateOf(track) ||
         (told->second.place - track.map_from_door.translation()).norm() > options_.moved_m;
}

std::optional<DoorTrack> DoorNews::Next(const DoorTracks& doors, Time now) {
  if (last_ && Seconds(now - *last_) < options_.every_s) return std::nullopt;
  const DoorTrack* next = nullptr;
  std::tuple<bool, Time> rank;
  for (const DoorTrack& track : doors.tracks()) {
    if (!doors.IsBelieved(track) || Seconds(now - track.seen) > options_.told_for_s) continue;
    const auto told = told_.find(track.id);
    const std::tuple here{!IsNews(doors, track), told == told_.end() ? Time{} : told->second.at};
    if (next && rank <= here) continue;
    next = &track;
    rank = here;
  }
  if (!next) return std::nullopt;
  last_ = now;
  told_[next->id] = {now, next->map_from_door.translation(), doors.StateOf(*next)};
  return *next;
}

}  // namespace priamos::head
