#include "bus/radio/channels/age_bound.hpp"

#include <algorithm>
#include <cmath>

#include "bus/radio/channels/entry_sizes.hpp"

namespace priamos::bus::radio {

AgeBound::AgeBound(const ChannelTable& table, Direction direction) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).direction != direction || table.at(i).fresh <= Duration::zero()) continue;
    channel_ = i;
    within_ = table.at(i).fresh;
    entry_bytes_ = static_cast<std::size_t>(std::ceil(SizesOf(table, i).entry_bits / 8));
  }
}

std::optional<AgeBound::First> AgeBound::Choose(const Waiting& waiting, Time begin) const {
  if (!now_.last || !waiting.state) return std::nullopt;
  const Time due = DueAfter(*now_.last);
  if (waiting.alone) {
    const bool in_time = begin + waiting.alone_takes + waiting.state_takes <= due;
    if (now_.promised || in_time) return First{.message = *waiting.alone, .end = due - waiting.state_takes};
    const Time end = DueAfter(begin) - waiting.state_takes - waiting.alone_takes;
    return First{.message = *waiting.state, .end = std::min(due, end), .promised = waiting.alone};
  }
  // The next one then goes in a frame that need not be short.
  const bool in_time = begin + waiting.others_take + waiting.longest_takes <= due;
  if (waiting.state->since > begin && in_time) return std::nullopt;
  return First{.message = *waiting.state, .end = due};
}

void AgeBound::OnFrame(bool with_state, const std::optional<First>& first, Time now) {
  before_ = now_;
  if (with_state) now_.last = now;
  now_.promised = first ? first->promised : std::nullopt;
}

}  // namespace priamos::bus::radio
