#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "cli/supervise/console_piece.hpp"
#include "common/time.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// Obeys process_order_t on one bus. An order is obeyed once: a repetition, also one that somebody plays
/// back, gets the answer of the first time again; one of more than kOldest is refused. Pure: time is an
/// argument.
class SupervisorDesk {
 public:
  static constexpr Duration kOldest = std::chrono::seconds(10);
  /// Orders that are answered within kOldest; the others of a flood are not.
  static constexpr std::size_t kMostOrders = 100;
  /// One process, or the world, is not started again more often than this.
  static constexpr Duration kPause = std::chrono::seconds(3);
  static constexpr std::size_t kMostText = 80;  ///< [byte] of process_report_t.text

  /// What is done for an order.
  struct Hands {
    std::function<bool(const std::string& process)> has;             ///< it is one of this bus
    std::function<std::string(const std::string& process)> restart;  ///< returns why it had ended before
    std::function<std::optional<ConsolePiece>(const std::string& process, std::int64_t end_bytes)> console;
    /// Begins the simulation anew; false for a scenario that is not on offer. None: nothing is simulated.
    std::function<bool(const std::string& scenario)> new_world = nullptr;
  };

  explicit SupervisorDesk(Hands hands) : hands_(std::move(hands)) {}

  /// The answer; nullopt when the order is for somebody else, or is one of a flood.
  std::optional<process_report_t> Take(const process_order_t& order, Time now);

 private:
  struct Answered {
    Time time;
    process_report_t answer;
  };
  bool IsMine(const process_order_t& order) const;
  const process_report_t* AnswerTo(const process_order_t& order) const;
  void Obey(const process_order_t& order, Time now, process_report_t& answer);
  void Tell(const process_order_t& order, process_report_t& answer) const;
  bool TooOften(const std::string& name, Time now);

  Hands hands_;
  std::deque<Answered> answered_;      ///< oldest first
  std::map<std::string, Time> begun_;  ///< when a process, or the world as "", was last started by an order
};

}  // namespace priamos::cli
