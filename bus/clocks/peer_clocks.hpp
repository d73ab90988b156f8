#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/clocks/clock_offset.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

/// Which clock stamped a message, as far as that is known of its sender.
struct SenderClock {
  /// What can be done with its stamps.
  enum class Kind : std::uint8_t {
    kOurs,     ///< they are of our own clock
    kKnown,    ///< `difference` translates them
    kUnknown,  ///< nothing of this sender's clock is known
    kCopied,   ///< its host says that its clock is ours, and is another one: a machine copied while it ran
  };
  Kind kind = Kind::kUnknown;
  ClockDifference difference{};
  std::string host;  ///< name of its computer; empty when it is unknown
};

/// The clocks of the processes on a bus, from the CLOCK messages that they send. Pure; everything it takes
/// may come from anybody.
///
/// A sender is the socket a message came from. One that sends no CLOCK (a foreign program) is taken to have
/// the clock of the others at its address; at an address of this host, ours.
class PeerClocks {
 public:
  static constexpr std::size_t kMostClocks = 16;    ///< others; of more, those heard first are used
  static constexpr std::size_t kMostSenders = 256;  ///< of more, none new is noticed
  /// A clock that was not heard for so long makes room for another.
  static constexpr Duration kForgotten{60'000'000};

  /// `own_id` names this clock, `own_addresses` are those of this host: IPv4, in the order of the network.
  PeerClocks(std::int32_t own_id, std::set<std::uint32_t> own_addresses)
      : own_id_(own_id), own_addresses_(std::move(own_addresses)) {}

  /// A clock is known well when it is known so exactly. Processes are busy when they start, and a message
  /// that waits makes an exchange inexact: during kAcquaintance there are as many exchanges as that takes.
  static constexpr Duration kWell{2'000}, kAcquaintance{3'000'000};

  /// Takes a CLOCK message that arrived at `now`. Returns true when its sender should get an answer at once:
  /// it, or we, do not know the other's clock well yet, or one of
  /// them is being slewed.
  bool Hear(std::uint64_t sender, const clock_report_t& message, Time now);

  SenderClock ClockOf(std::uint64_t sender, Time now) const;

  /// A doubt that no exchange has settled ends after this; after one that ended there is none for as long.
  static constexpr Duration kDoubt{1'000'000};
  /// Something about the messages of that sender makes it likely that its clock has stepped. Until the next
  /// exchange its clock is in doubt: Report asks for an answer at once, as if it were unknown. Returns
  /// whether it is in doubt.
  bool Doubt(std::uint64_t sender, Time now);

  /// Whether the message names our clock and does not come from this host, as far as its addresses are known.
  bool IsCopy(std::uint64_t sender, const clock_report_t& message) const;
  /// This host has other addresses than before.
  void SetOwnAddresses(std::set<std::uint32_t> addresses) { own_addresses_ = std::move(addresses); }

  /// How far our clock is ahead of the reference: of all clocks heard in the last kForgotten and ours, that
  /// of the lowest number, so that all who hear each other mean the same one. nullopt while it is not known,
  /// and while another host uses our number.
  std::optional<ClockDifference> AheadOfReference(Time now) const;

  /// What this process tells the others, to be sent at `now`; without the name of its host.
  clock_report_t Report(Time now) const;

 private:
  struct Peer {
    std::string host;
    std::int64_t newest_utime = 0;  ///< of its CLOCK messages, by its clock
    Time arrived{};
    Time first_heard{};
    std::optional<Time> doubted;  ///< since when
    Time settled{};               ///< when the last doubt ended
    ClockOffset offset;
  };
  Peer* PeerWithRoom(std::int32_t id, Time now);
  void TakeExchange(Peer& peer, const clock_report_t& message, std::size_t i, Time now) const;
  static void Settle(Peer& peer, Time now);
  std::optional<std::int32_t> IdOf(std::uint64_t sender) const;

  std::int32_t own_id_;
  std::set<std::uint32_t> own_addresses_;
  std::map<std::int32_t, Peer> peers_;
  std::map<std::uint64_t, std::int32_t> by_sender_;
  std::map<std::uint32_t, std::int32_t> by_address_;
  std::map<std::uint64_t, std::string> copies_;  ///< senders with our number at other hosts, whose names
  Time copy_heard_{};
};

}  // namespace priamos::bus
