#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bus/radio/line/line.hpp"
#include "bus/radio/line/shared_line.hpp"
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
  int robots = 0;     ///< with more than 0, `a` is the station's tty and `b`-1, `b`-2, ... are theirs
  bool json = false;  ///< print the ttys that were made as JSON
};

/// Reads a blackout schedule; lines that begin with # and a heading are passed over. Throws ConfigError,
/// `file:line: expected ..., got ...`.
std::vector<bus::radio::LineCut> ReadBlackouts(const std::string& path);

/// Reads a schedule of delays, as ReadBlackouts; `way` is a_to_b, b_to_a or both.
std::vector<bus::radio::LineDelay> ReadDelays(const std::string& path);

/// One pseudo terminal, found under the name of a symbolic link. What a program writes to the link's target
/// comes out of Read().
class PseudoTerminal {
 public:
  /// Replaces a link left behind; throws std::runtime_error when something else has the name.
  explicit PseudoTerminal(std::string link);
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;
  ~PseudoTerminal();

  int fd() const { return master_; }
  std::vector<std::byte> Read(std::size_t most);
  /// Writes bytes; those that no program reads are lost, as on a modem.
  void Write(std::span<const std::byte> bytes);

 private:
  std::string link_;
  std::string target_;
  int master_ = -1;
  int slave_ = -1;  ///< kept open, so that the line survives the programs at its ends
};

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

/// Names of the ttys that are made, the station's first.
std::vector<std::string> TtysOf(const LinkEmulateOptions& options);

/// Emulates until SIGINT or SIGTERM and returns 0. Throws ConfigError or std::runtime_error.
int RunLinkEmulate(const LinkEmulateOptions& options);

}  // namespace priamos::cli
