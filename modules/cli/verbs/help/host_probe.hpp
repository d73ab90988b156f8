#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bus/clocks/clock_offset.hpp"
#include "cli/verbs/help/doctor.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// What `priamos doctor --probe` heard while it asked: from it follows which hosts hear each other. Pure.
///
/// A question goes to the bus. Whoever hears it answers twice: to the bus, and to the asking socket alone. An
/// answer to the bus: both ways work. Only one to the socket: that host hears this one, and its own way to
/// the bus is cut. None, while other messages of that host arrive: this host's way is cut.
class HostProbe {
 public:
  /// Which host and network this is, and the instance that its questions carry.
  struct Self {
    std::int32_t host_id = 0, instance = 0;
    std::set<std::string> addresses;  ///< of its interfaces; what comes from there is its own
    std::string network;              ///< interface by which it sends
    int ttl = 0;
    std::string bus;  ///< URL, for the commands
  };
  explicit HostProbe(Self self) : self_(std::move(self)) {}

  /// Takes notice of a question sent at `now`; they are numbered from 1.
  void Asked(Time now) { asked_.push_back(now); }
  /// Takes a PROBE that arrived at `now`, whoever meant it; `alone`: it came to the asking socket.
  void HearProbe(const probe_t& message, const std::string& address, bool alone, Time now);
  /// Takes notice of any other message on the bus. `host`: the sender's name if the message has it.
  void HearOther(const std::string& address, const std::string& host = "");

  /// Takes what a process says of its host's clock in HEALTH, the newest time.
  void HearClock(const std::string& address, const health_t& message);

  /// Takes notice of a clock's number in CLOCK. One that comes from two hosts is that of a machine that was
  /// copied while it ran.
  void HearNumber(const std::string& address, std::int32_t clock_id);

  /// Takes what an end of the radio link says, the newest time.
  void HearLink(const link_status_t& message) { links_[message.onboard != 0] = message; }

  /// A line per way that works or is cut, per end of the radio that is heard, and per process whose clock is
  /// not known exactly enough;
  /// `expected`: names of hosts that have to be there.
  std::vector<Finding> Findings(const std::vector<std::string>& expected) const;

 private:
  struct Host {
    std::string name, address, network;
    int ttl = 0;
    std::set<std::string> processes;
    std::set<std::int32_t> on_bus, alone;  ///< numbers of the questions that were answered so
    bool heard = false;                    ///< something of it came over the bus
    bus::ClockOffset clock;
  };
  bool IsOwn(const std::string& address) const;
  Finding Legs(const Host& host) const;
  Finding Works(const Host& host) const;
  Finding CutFrom(const Host& host) const;
  Finding CutTo(const std::string& who) const;
  std::string NameOf(const std::string& address) const;
  void AddClocks(std::vector<Finding>& findings) const;
  void AddCopies(std::vector<Finding>& findings) const;
  bool IsCopied(const std::string& address) const;

  Self self_;
  std::vector<Time> asked_;  ///< when
  std::map<std::int32_t, Host> hosts_;
  std::map<std::pair<std::string, std::string>, double> clocks_;  ///< [s]; by address and process: how exact
  std::map<std::int32_t, std::set<std::string>> speakers_;        ///< of a clock's number: their addresses
  std::map<bool, link_status_t> links_;                           ///< by whether it is the robot's end
  std::map<std::string, std::string> others_;  ///< heard on the bus: address, and name if known
};

}  // namespace priamos::cli
