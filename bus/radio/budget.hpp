#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/line/polling.hpp"
#include "bus/radio/link_options.hpp"

/// Load and worst-case latencies that a link's configuration asks of the line, computed before anything is
/// sent.
namespace priamos::bus::radio {

/// What the time-to-live of a command that is the next to go is spent on before the receiver may obey it.
struct FreshnessProof {
  Duration next{};     ///< from its offer to its last byte at the receiver, without the line's delay
  Duration delay{};    ///< of the line, there and back
  Duration ahead{};    ///< the frame that it echoes was handed over so long before it left
  Duration step{};     ///< lost by the rounding of its offset
  Duration silence{};  ///< by which the frame that it echoes may be older than the offset can say
  /// Longest time for which an echo can be counted on: on a slower or more silent line no command is sent.
  Duration reach{};
  /// Longest age of the newest frame of the other end, and the delay of the line.
  Duration echo_age{};
  /// Largest age that the receiver must assume.
  Duration age() const { return next + delay + ahead + step + silence; }
  /// Smallest time-to-live with which age() is within it: the rounding and the silence depend on it.
  Duration least() const;
};

/// Whether the `fresh_s` of a state can be kept.
struct FreshBound {
  Duration least{};  ///< smallest that can
  /// Time that it may become beside urgent events; nullopt: it cannot be kept.
  std::optional<Duration> beside_urgent{};
};

/// Load of one channel at its configured rate.
struct ChannelBudget {
  std::size_t channel = 0;
  std::size_t bits = 0;  ///< largest size in a bundle, channel number and head included (event: all segments)
  double rate_hz = 0;    ///< rate of all keys together
  double bytes_per_s = 0;  ///< load on a busy line, with its share of the overhead of full frames
  double share = 0;        ///< `bytes_per_s` over what the line carries
  /// Longest time from Offer() to the last byte at the receiver, without the line's own latency, on an
  /// error-free line whose channels keep their rates; nullopt: not bounded within a minute.
  std::optional<Duration> worst_latency;
  std::optional<FreshBound> fresh{};      ///< of the state whose age is bounded
  std::optional<FreshnessProof> proof{};  ///< commands only
};

/// Load of one direction of the line.
struct DirectionBudget {
  Direction direction = Direction::kUp;
  std::vector<ChannelBudget> channels;
  double control_bytes_per_s = 0;   ///< load of the acknowledgements
  double bytes_per_s = 0;           ///< load of everything
  double capacity_bytes_per_s = 0;  ///< capacity of the line; half-duplex: what the other end leaves of it
  std::size_t longest_frame_bytes = 0;  ///< with the whole counter
  double utilisation = 0;               ///< `bytes_per_s` over `capacity_bytes_per_s`
};

/// Load of both directions, and why the configuration cannot be used.
struct Budget {
  DirectionBudget up, down;
  /// One sentence each, `file:line:key: expected ..., got ...`; empty when the configuration holds.
  std::vector<std::string> problems;
  int robots = 0;              ///< on a channel that they share; 0: a link of two ends
  PollBounds polls{};          ///< of a shared channel
  std::size_t code_bytes = 0;  ///< length of the codes of data frames
  double forgery_s = 0;        ///< ForgerySeconds of this line with such codes
};

/// Worst-case latencies by response-time analysis as for CAN (Davis, Burns, Bril, Lukkien, Real-Time Systems
/// 35(3), 2007), adapted to frames that carry several messages: a frame is not interrupted except by an
/// urgent channel; a frame that leaves a waiting message out is full of messages that go before it. Messages
/// that overtake by ageing are counted among those. On a half-duplex radio an end may only talk in its turns:
/// the other end's longest turn is added for every own turn that the transmission needs (periodic resource
/// model, Shin and Lee, Real-Time Systems Symposium 2003).
///
/// On a channel that several robots share, each turn is one frame: a message takes as many cycles of polls as
/// frames go before it.
///
/// A command is proven fresh by an echo of the receiver's own frames, so that its age counts from the other
/// direction as well. Its time-to-live must hold what a command takes that is the next to go, the delay of
/// the line there and back, what is written ahead, what the offset loses, and what the other direction's
/// silence exceeds the range of the offset by. Emergency stops and bursts are left out, other than for a
/// deadline: the one that comes too late behind them is refused, and the next one obeyed.
///
/// A state is dropped when it is older than its time-to-live before its turn: that must hold its worst
/// latency.
Budget ComputeBudget(const ChannelTable& table, const LinkOptions& options);

/// Checks that the link can keep its deadlines. Throws ConfigError with the first problem of ComputeBudget.
void RequireBudget(const ChannelTable& table, const LinkOptions& options);

/// The table that `priamos link budget` shows.
std::string FormatBudget(const ChannelTable& table, const Budget& budget);

}  // namespace priamos::bus::radio
