#include "bus/clocks/clock_exchange.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "bus/clocks/host_clock.hpp"
#include "bus/clocks/log_time.hpp"
#include "bus/host/host_identity.hpp"
#include "bus/schema/stamps.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/multicast.hpp"
#include "bus/wire/network_interface.hpp"
#include "bus/wire/typed_message.hpp"

namespace priamos::bus {
namespace {

constexpr Duration kEvery{1'000'000};
constexpr Duration kBetweenAnswers{50'000};
constexpr Duration kNews{10'000'000};
constexpr std::size_t kHostBytes = 64;  // @max of clock_report_t.host

std::set<std::uint32_t> AddressesOfThisHost() {
  std::set<std::uint32_t> addresses;
  for (const NetworkInterface& interface : NetworkInterfaces())
    for (const std::string& text : interface.addresses)
      if (in_addr address{}; inet_pton(AF_INET, text.c_str(), &address) == 1)
        addresses.insert(address.s_addr);
  return addresses;
}

/// An order to stop is obeyed whatever its stamp says. A question whether hosts hear each other is answered
/// by everybody who hears it: nobody reads its stamp, and it is asked where something is wrong.
bool MeansTheSameAtAnyTime(std::string_view name) {
  return name == channels::kProbe.name ||
         std::apply(
             [name](const auto&... channel) {
               return ((channel.safety_act != nullptr && channel.name == name) || ...);
             },
             channels::kAll);
}

/// A state is said again and again: one that is refused is soon there anew.
bool IsState(std::string_view name) {
  return std::apply(
      [name](const auto&... channel) { return ((channel.rate_hz > 0 && channel.name == name) || ...); },
      channels::kAll);
}

/// Whether `wait` has passed since `then`; a clock that stepped back makes nobody wait longer.
bool HasPassed(Duration wait, Time then, Time now) {
  return now - then >= wait || now < then;
}

/// Why messages with stamps of that clock are refused.
std::string ReasonToRefuse(const SenderClock& clock) {
  if (clock.kind == SenderClock::Kind::kCopied)
    return "it runs with our clock's number, as a machine does that was copied while it ran; start its "
           "processes again";
  if (clock.kind == SenderClock::Kind::kKnown)
    return fmt::format("its clock is known to {:.0f} ms only", 1000 * Seconds(clock.difference.uncertainty));
  return "its clock is not known yet";
}

}  // namespace

std::unique_ptr<ClockExchange> ExchangeWhereNeeded(LcmBus& bus, const Schema& schema,
                                                   const HostClock& clock) {
  const bool leaves = bus.url().starts_with("udpm://") && TtlOf(bus.url()) > 0;
  return leaves
             ? std::make_unique<ClockExchange>(bus, schema, clock, clock.IdAt(DepartureOf(bus.url()).address))
             : nullptr;
}

ClockExchange::ClockExchange(LcmBus& bus, const Schema& schema, const Clock& clock, std::int32_t own_id)
    : bus_(bus),
      schema_(schema),
      clock_(clock),
      host_(ThisHost().name.substr(0, kHostBytes)),
      peers_(own_id, AddressesOfThisHost()),
      begin_(clock.Now()) {
  bus.Subscribe(channels::kClock.name, [](std::string_view, std::span<const std::byte>) {});
  bus.TranslateBy([this](std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes) {
    return Translate(sender, channel, bytes);
  });
  Tick(begin_);
}

ClockExchange::~ClockExchange() {
  bus_.TranslateBy(nullptr);
}

void ClockExchange::Tick(Time now) {
  ticked_ = now;
  const bool answers = answer_asked_ && HasPassed(kBetweenAnswers, answered_, now);
  next_ = std::min(next_, now + kEvery);
  if (now < next_ && !answers) return;
  if (answers) answered_ = now;
  answer_asked_ = answer_asked_ && !answers;
  if (now >= next_) next_ = now + kEvery;
  Send(now);
}

void ClockExchange::Send(Time now) {
  clock_report_t message = peers_.Report(now);
  message.host = host_;
  bus_.Publish(channels::kClock.name, Encode(message));
}

void ClockExchange::Hear(std::uint64_t sender, std::span<const std::byte> bytes) {
  const auto message = DecodeChecked<clock_report_t>(schema_, bytes);
  const Time now = clock_.Now();
  if (!message) return;
  if (peers_.IsCopy(sender, *message)) LookAtAddresses(now);
  if (!peers_.Hear(sender, *message, now)) return;
  answer_asked_ = true;
  Tick(now);
}

/// This host may have got another address since.
void ClockExchange::LookAtAddresses(Time now) {
  if (!HasPassed(kEvery, looked_at_addresses_, now)) return;
  looked_at_addresses_ = now;
  peers_.SetOwnAddresses(AddressesOfThisHost());
}

std::span<const std::byte> ClockExchange::Shifted(std::span<const std::byte> bytes, Duration by) {
  const Struct* type = schema_.Of(bytes);
  if (type == nullptr) return bytes;
  shifted_.assign(bytes.begin(), bytes.end());
  return ShiftStamps(*type, shifted_, by.count()) ? std::span<const std::byte>(shifted_) : bytes;
}

std::optional<std::span<const std::byte>> ClockExchange::Translate(std::uint64_t sender,
                                                                   std::string_view channel,
                                                                   std::span<const std::byte> bytes) {
  const Time now = clock_.Now();
  if (channel == channels::kClock.name) {
    Hear(sender, bytes);
    SignOfAStep(sender, channel, bytes, peers_.ClockOf(sender, now), now);
    return bytes;
  }
  const SenderClock clock = peers_.ClockOf(sender, now);
  if (clock.kind == SenderClock::Kind::kOurs) return bytes;
  const bool needs_time = !MeansTheSameAtAnyTime(channel);
  if (needs_time && IsTooUncertain(clock, now)) return Refuse(clock, ReasonToRefuse(clock), now);
  if (std::string sign = SignOfAStep(sender, channel, bytes, clock, now); needs_time && !sign.empty())
    return Refuse(clock, std::move(sign), now);
  if (clock.kind == SenderClock::Kind::kKnown) return Shifted(bytes, -clock.difference.ahead);
  ++unknown_;
  unknown_at_ = now;
  return bytes;
}

std::nullopt_t ClockExchange::Refuse(const SenderClock& clock, std::string reason, Time now) {
  ++refused_;
  refused_at_ = now;
  refused_host_ = clock.host;
  refused_reason_ = std::move(reason);
  return std::nullopt;
}

bool ClockExchange::Doubt(std::uint64_t sender, Time now) {
  if (!peers_.Doubt(sender, now)) return false;
  answer_asked_ = true;
  if (HasPassed(kBetweenAnswers, answered_, now)) {
    answered_ = now;
    Send(now);
  }
  return true;
}

std::string ClockExchange::SignOfAStep(std::uint64_t sender, std::string_view channel,
                                       std::span<const std::byte> bytes, const SenderClock& clock, Time now) {
  const auto stamp = clock.kind == SenderClock::Kind::kKnown ? StampOf(schema_, bytes) : std::nullopt;
  if (!stamp || !LogTime::IsPlausible(*stamp)) return "";
  const Duration age = now + clock.difference.ahead - *stamp;
  const auto verdict = ages_.Judge(sender, channel, age, clock.difference.uncertainty, now - ticked_);
  if (verdict == AgeWatch::Verdict::kFuture) {
    Doubt(sender, now);
    return fmt::format("stamped {:.3g} s ahead: its clock stepped, or a program stamps by another",
                       -Seconds(age));
  }
  if (verdict == AgeWatch::Verdict::kOlder && Doubt(sender, now))
    return IsState(channel)
               ? fmt::format("{:.3g} s old at once: late, or its clock stepped; was measured anew",
                             Seconds(age))
               : "";
  ages_.Note(sender, channel, age, now);
  return "";
}

bool ClockExchange::IsTooUncertain(const SenderClock& clock, Time now) const {
  if (clock.kind == SenderClock::Kind::kKnown) return clock.difference.uncertainty > kMostUncertain;
  if (clock.kind == SenderClock::Kind::kCopied) return true;
  return !clock.host.empty() || now - begin_ < kGreeting;
}

std::string ClockExchange::Problems(Time now) const {
  std::string text;
  if (refused_ > 0 && now - refused_at_ < kNews)
    text = fmt::format("{} messages of {} refused: {}", refused_,
                       refused_host_.empty() ? "other hosts" : refused_host_, refused_reason_);
  if (unknown_ > 0 && now - unknown_at_ < kNews)
    text += fmt::format("{}{} messages of hosts of unknown clock", text.empty() ? "" : "; ", unknown_);
  return text;
}

}  // namespace priamos::bus
