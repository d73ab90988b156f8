#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/radio/frame/kiss.hpp"
#include "bus/radio/line/line.hpp"
#include "bus/radio/line/packet_air.hpp"
#include "bus/radio/line/shared_line.hpp"
#include "cli/supervise/pseudo_terminal.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// An emulated pair of radio modems: two pseudo terminals joined by an emulated line. With robots a channel
/// that they share with a station.
struct LinkEmulateOptions {
  std::string a = "tty-a";  ///< links to the ttys are made here and removed at the end
  std::string b = "tty-b";
  bus::radio::LineConfig line;
  std::string blackouts;  ///< CSV file, `from_s,to_s` per line: more times without a line
  std::string delays;     ///< CSV file, `way,from_s,to_s,first_s,last_s` per line: times with more delay
  std::uint64_t seed = 1;
  /// With it, packet radios instead of a line: each tty speaks KISS. `line` gives their half-duplex,
  /// latency_s and, as air_rate_bytes_s, their rate.
  std::optional<bus::radio::PacketAirConfig> packets{};
  int robots = 0;     ///< with more than 0, `a` is the station's tty and `b`-1, `b`-2, ... are theirs
  bool json = false;  ///< print the ttys that were made as JSON
};

/// Reads a blackout schedule; lines that begin with # and a heading are passed over. Throws ConfigError,
/// `file:line: expected ..., got ...`.
std::vector<bus::radio::LineCut> ReadBlackouts(const std::string& path);

/// Reads a schedule of delays, as ReadBlackouts; `way` is a_to_b, b_to_a or both.
std::vector<bus::radio::LineDelay> ReadDelays(const std::string& path);

/// What joins pseudo terminals; time is given, so that a test need not wait.
class EmulatedMedium {
 public:
  virtual ~EmulatedMedium() = default;
  /// Moves the bytes that are due at `now`.
  virtual void Step(Time now) = 0;
  /// Time at which the next byte is due; Time::max() when none is under way.
  virtual Time NextArrival() const = 0;
  /// File descriptors that become readable when a program writes.
  virtual std::vector<int> fds() const = 0;
};

/// Both directions between two pseudo terminals.
class EmulatedLine : public EmulatedMedium {
 public:
  EmulatedLine(const LinkEmulateOptions& options, Time start);

  void Step(Time now) override;
  Time NextArrival() const override;
  std::vector<int> fds() const override { return {a_.fd(), b_.fd()}; }
  const PseudoTerminal& a() const { return a_; }
  const PseudoTerminal& b() const { return b_; }

 private:
  PseudoTerminal a_, b_;
  bus::radio::LinePair lines_;
};

/// One radio channel that a station and several robots share: everybody hears everybody, who sends is deaf,
/// and of two that send at once nobody is understood.
class EmulatedChannel : public EmulatedMedium {
 public:
  EmulatedChannel(const LinkEmulateOptions& options, Time start);

  void Step(Time now) override;
  Time NextArrival() const override { return air_.next_arrival(); }
  std::vector<int> fds() const override;

 private:
  std::vector<std::unique_ptr<PseudoTerminal>> ttys_;  ///< the station's, then the robots'
  bus::radio::SharedLine air_;
};

/// Two packet radios, each at a tty that speaks KISS.
class EmulatedPacketRadios : public EmulatedMedium {
 public:
  /// `options.packets` must be given.
  EmulatedPacketRadios(const LinkEmulateOptions& options, Time start);

  void Step(Time now) override;
  Time NextArrival() const override { return air_.next_arrival(); }
  std::vector<int> fds() const override { return {ttys_[0].fd(), ttys_[1].fd()}; }

 private:
  PseudoTerminal ttys_[2];
  bus::radio::KissDecoder decoders_[2];
  bus::radio::PacketAir air_;
};

/// Names of the ttys that are made, the station's first.
std::vector<std::string> TtysOf(const LinkEmulateOptions& options);

/// Emulates until SIGINT or SIGTERM and returns 0. Throws ConfigError or std::runtime_error.
int RunLinkEmulate(const LinkEmulateOptions& options);

}  // namespace priamos::cli
