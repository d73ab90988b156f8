#include "head/core/tracks/turn_taking.hpp"

#include <tuple>

namespace priamos::head {

bool TurnTaking::IsNews(const Tellable& thing) const {
  const auto told = told_.find(thing.id);
  return told == told_.end() || told->second.state != thing.state ||
         (told->second.place - thing.place).norm() > options_.moved_m;
}

std::optional<int> TurnTaking::Next(std::span<const Tellable> things, Time now) {
  if (last_ && Seconds(now - *last_) < options_.every_s) return std::nullopt;
  const Tellable* next = nullptr;
  std::tuple<bool, int, Time> rank;
  for (const Tellable& thing : things) {
    const auto told = told_.find(thing.id);
    const bool is_old = !IsNews(thing);
    if (is_old && options_.news_only) continue;
    const std::tuple here{is_old, is_old ? 0 : -thing.weight, told == told_.end() ? Time{} : told->second.at};
    if (next && rank <= here) continue;
    next = &thing;
    rank = here;
  }
  if (!next) return std::nullopt;
  last_ = now;
  told_[next->id] = {now, next->place, next->state};
  return next->id;
}

}  // namespace priamos::head
