#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/clocks/age_watch.hpp"
#include "bus/clocks/clock.hpp"
#include "bus/clocks/peer_clocks.hpp"

namespace priamos::bus {

class HostClock;
class LcmBus;
class Schema;

/// Makes the clocks of a bus's hosts comparable, for one process: exchanges CLOCK messages with the others,
/// and gives every message that arrives stamps of this process's clock. Every process of RunProcess on a bus
/// that leaves its host has one.
///
/// A message of a host whose clock is known less exactly than kMostUncertain is refused and counted, but for
/// those of safety channels and PROBE. So are stamps that show that the clock has stepped (AgeWatch): those
/// of the future, and, until an exchange that is asked for at once has said which it is, states that are
/// older than usual; an event may be, because nobody says it again. What comes from a sender who never spoke
/// of its clock (a foreign program) is handed on as it is, from kGreeting after the start on.
class ClockExchange {
 public:
  /// 20 ms are 6 mm at the 0.3 m/s at which the robot looks at a door.
  static constexpr Duration kMostUncertain{20'000};

  /// Until then everybody who speaks of his clock has answered the first message.
  static constexpr Duration kGreeting{500'000};

  /// Subscribes to CLOCK, translates what `bus` receives from now on, and sends the first message. `own_id`
  /// names `clock` (HostClock::IdAt). All of them must outlive it.
  ClockExchange(LcmBus& bus, const Schema& schema, const Clock& clock, std::int32_t own_id);
  ~ClockExchange();
  ClockExchange(const ClockExchange&) = delete;
  ClockExchange& operator=(const ClockExchange&) = delete;

  /// Sends when it is time to; call it about every 50 ms.
  void Tick(Time now);

  /// Messages refused because the clock of their host was not known exactly enough.
  std::uint64_t refused() const { return refused_; }
  /// How far this clock is ahead of the reference clock of the bus; nullopt while that is not known.
  std::optional<ClockDifference> AheadOfReference(Time now) const { return peers_.AheadOfReference(now); }
  /// What was wrong with the clocks in the last 10 s, as a clause; empty when nothing was.
  std::string Problems(Time now) const;

 private:
  std::optional<std::span<const std::byte>> Translate(std::uint64_t sender, std::string_view channel,
                                                      std::span<const std::byte> bytes);
  std::span<const std::byte> Shifted(std::span<const std::byte> bytes, Duration by);
  /// Why a message is refused though its clock is known; empty: it is not.
  std::string SignOfAStep(std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes,
                          const SenderClock& clock, Time now);
  bool Doubt(std::uint64_t sender, Time now);
  std::nullopt_t Refuse(const SenderClock& clock, std::string reason, Time now);
  /// Whether stamps of that clock are known too badly to be used.
  bool IsTooUncertain(const SenderClock& clock, Time now) const;
  void Hear(std::uint64_t sender, std::span<const std::byte> bytes);
  void Send(Time now);
  void LookAtAddresses(Time now);

  LcmBus& bus_;
  const Schema& schema_;
  const Clock& clock_;
  std::string host_;
  PeerClocks peers_;
  AgeWatch ages_;
  Time next_{};      ///< of the messages once a second
  Time answered_{};  ///< when the last answer out of turn was sent
  Time ticked_{};    ///< then nothing waited on the bus
  Time looked_at_addresses_{};
  bool answer_asked_ = false;
  std::vector<std::byte> shifted_;
  std::uint64_t refused_ = 0, unknown_ = 0;
  Time begin_, refused_at_{}, unknown_at_{};
  std::string refused_host_, refused_reason_;  ///< of the newest refused message
};

/// An exchange on a bus that other hosts may hear; null on one that stays on this host. All of them must
/// outlive it.
std::unique_ptr<ClockExchange> ExchangeWhereNeeded(LcmBus& bus, const Schema& schema, const HostClock& clock);

}  // namespace priamos::bus
