#include "bus/clocks/log_time.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

constexpr Time kLatest{Duration(7'258'118'400'000'000)};  // the year 2200

}  // namespace

std::optional<Time> StampOf(const Schema& schema, std::span<const std::byte> bytes) {
  const Struct* type = schema.Of(bytes);
  if (type == nullptr || type->fields.empty() || !type->fields.front().annotation.age_us ||
      !Walk(*type, bytes))
    return std::nullopt;
  return FromUtime(ReadBigEndian<std::int64_t>(bytes.data() + sizeof(std::uint64_t)));
}

std::uint64_t IdentityOf(std::string_view channel, std::span<const std::byte> bytes) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;  // so that equal parts do not cancel
  const std::hash<std::string_view> hash;
  return hash(channel) * kOdd ^ hash({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

bool LogTime::IsPlausible(Time stamp) {
  return stamp > Time{} && stamp < kLatest;
}

bool LogTime::IsWitnessed(Time stamp) {
  const bool agrees = witnesses_ > 0 && std::chrono::abs(stamp - leap_) <= kLeap;
  witnesses_ = agrees ? witnesses_ + 1 : 1;
  leap_ = stamp;
  return witnesses_ >= kWitnesses;
}

void LogTime::Hear(Time stamp, std::optional<std::uint64_t> identity) {
  if (went_back() || !IsPlausible(stamp)) return;
  behind_ = now_ && *now_ - stamp > kBack ? behind_ + 1 : 0;
  far_behind_ += behind_ > 0 ? 1 : 0;
  if (identity) repeated_.Hear(*identity, stamp, now_.value_or(Time::min()));
  if (now_ && stamp - *now_ > kLeap && !IsWitnessed(stamp)) return;
  witnesses_ = 0;
  now_ = std::max(stamp, now_.value_or(stamp));
}

void BeginningAgain::Note(const LogTime& time, std::string_view channel, std::span<const std::byte> bytes) {
  if (time.is_behind())
    messages_.push_back({std::string(channel), {bytes.begin(), bytes.end()}});
  else
    messages_.clear();
}

std::vector<HeardMessage> BeginningAgain::Take() {
  return std::exchange(messages_, {});
}

}  // namespace priamos::bus
