#include "bus/log/log_survey.hpp"

#include <algorithm>
#include <optional>

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

/// Numbers left out when `number` follows where `expected` should; nullopt when it is no gap.
std::optional<std::uint64_t> GapBefore(std::int64_t number, std::int64_t expected) {
  const auto ahead = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(expected);
  return number >= expected && ahead <= kLargestGap ? std::optional(ahead) : std::nullopt;
}

/// Events missing from the recorder's numbers. A number that does not follow the one before is doubtful until
/// the next ones are seen: when they go on from it, it was right, and what it left out is missing; when they
/// go on as if it had been the next, it was damaged, and nothing is.
class NumberSequence {
 public:
  void Add(std::int64_t number) {
    if (!started_ || number == Behind(expected_, doubtful_)) return Trust(number);
    const auto gap = doubtful_ > 0 ? GapBefore(number, next_) : std::nullopt;
    if (gap == 0U) {
      missing_ += gap_;
      return Trust(number);
    }
    if (!gap) {  // those before were wrong: a number of the log each
      expected_ = Behind(expected_, doubtful_);
      doubtful_ = gap_ = 0;
    }
    gap_ += gap ? *gap : GapBefore(number, expected_).value_or(0);
    next_ = Behind(number, 1);
    ++doubtful_;
  }
  std::uint64_t Missing() const { return missing_ + gap_; }

 private:
  void Trust(std::int64_t number) {
    started_ = true;
    expected_ = Behind(number, 1);
    doubtful_ = gap_ = 0;
  }

  bool started_ = false;
  std::int64_t expected_ = 0;   ///< behind the last number that is certain
  std::int64_t next_ = 0;       ///< behind the last doubtful one
  std::uint64_t doubtful_ = 0;  ///< events since the last certain number
  std::uint64_t missing_ = 0, gap_ = 0;
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
  survey.first_damage = reader.first_damage();
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
