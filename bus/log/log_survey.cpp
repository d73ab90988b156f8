#include "bus/log/log_survey.hpp"

#include <algorithm>

#include "bus/log/type_texts.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

/// A jump by more than this is a damaged number or a joined log, not a loss.
constexpr std::uint64_t kLargestGap = 1'000'000;

/// Number `n` behind another one. A log may hold any number, so this wraps.
std::int64_t Behind(std::int64_t number, std::uint64_t n) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(number) + n);
}

/// Events missing from the recorder's numbers. A gap counts when the event behind it goes on from there: one
/// damaged number is no loss.
class NumberSequence {
 public:
  void Add(std::int64_t number) {
    const bool proves_gap = gap_ > 0 && number == gap_end_;
    const bool disproves_gap =
        gap_ > 0 && number == Behind(expected_, 1);  // only the number before was wrong
    if (proves_gap) missing_ += gap_;
    gap_ = 0;
    const auto ahead = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(expected_);
    if (started_ && !proves_gap && !disproves_gap && number > expected_ && ahead <= kLargestGap) {
      gap_ = ahead;
      gap_end_ = Behind(number, 1);
      return;  // the next event decides which number was wrong
    }
    started_ = true;
    expected_ = Behind(number, 1);
  }
  std::uint64_t Missing() const { return missing_ + gap_; }

 private:
  bool started_ = false;
  std::int64_t expected_ = 0;
  std::uint64_t missing_ = 0, gap_ = 0;
  std::int64_t gap_end_ = 0;  ///< the number that proves the gap
};

void Count(LogSurvey::Channel& channel, const LogEvent& event, LogTypes& types) {
  const Struct* type = types.Of(event.bytes);
  channel.types.insert(type ? type->full_name : "?");
  channel.undecodable += type == nullptr || !Walk(*type, event.bytes);
  channel.first_utime = channel.events == 0 ? event.utime : std::min(channel.first_utime, event.utime);
  channel.last_utime = channel.events == 0 ? event.utime : std::max(channel.last_utime, event.utime);
  channel.bytes += event.bytes.size();
  ++channel.events;
}

}  // namespace

double LogSurvey::Channel::RateHz() const {
  const auto span_us = static_cast<double>(last_utime - first_utime);
  return events > 1 && span_us > 0 ? static_cast<double>(events - 1) / span_us * 1e6 : 0;
}

LogSurvey Survey(LogReader& reader, const Schema& schema) {
  LogSurvey survey;
  survey.size_bytes = reader.size();
  NumberSequence numbers;
  LogTypes types(&schema);
  while (const auto event = reader.Next()) {
    numbers.Add(event->number);
    types.Take(event->bytes);
    Count(survey.channels[event->channel], *event, types);
    ++survey.events;
  }
  survey.missing_numbers = numbers.Missing();
  survey.skipped_bytes = reader.skipped_bytes();
  survey.damaged_places = reader.damaged_places();
  bool first = true;
  for (const auto& [name, channel] : survey.channels) {
    survey.undecodable += channel.undecodable;
    survey.first_utime = first ? channel.first_utime : std::min(survey.first_utime, channel.first_utime);
    survey.last_utime = first ? channel.last_utime : std::max(survey.last_utime, channel.last_utime);
    first = false;
  }
  return survey;
}

}  // namespace priamos::bus
