#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/supervise/console_piece.hpp"
#include "cli/supervise/supervisor.hpp"
#include "common/time.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// Obeys process_order_t on one bus. An order is obeyed once: a repetition, also one that somebody plays
/// back, gets the answer of the first time again; one of more than kOldest is refused. A restart is answered
/// when its process is ready again, or after kReadyWithin. Pure: time is an argument.
class SupervisorDesk {
 public:
  static constexpr Duration kOldest = std::chrono::seconds(10);
  /// Orders that are answered within kOldest; the others of a flood are not.
  static constexpr std::size_t kMostOrders = 100;
  /// One process, or the world, is not started again more often than this.
  static constexpr Duration kPause = std::chrono::seconds(3);
  /// A restart that takes longer than this is answered all the same: who ordered it waits 8 s, and the answer
  /// may have a radio to cross. So an answer within this time of the order says that the process is ready.
  static constexpr Duration kReadyWithin = std::chrono::seconds(5);
  static constexpr std::size_t kMostText = 80;  ///< [byte] of process_report_t.text

  /// What is done for an order.
  struct Hands {
    /// How a process is; nullopt when it is none of this bus.
    std::function<std::optional<ProcessReport>(const std::string& process)> look;
    std::function<void(const std::string& process)> restart;
    std::function<std::optional<ConsolePiece>(const std::string& process, std::int64_t end_bytes)> console;
    /// Begins the simulation anew; false for a scenario that is not on offer. None: nothing is simulated.
    std::function<bool(const std::string& scenario)> new_world = nullptr;
  };

  explicit SupervisorDesk(Hands hands) : hands_(std::move(hands)) {}

  /// The answer; nullopt when the order is for somebody else, is one of a flood, or is answered by Step.
  std::optional<process_report_t> Take(const process_order_t& order, Time now);
  /// Answers to restarts that have come to an end.
  std::vector<process_report_t> Step(Time now);

 private:
  struct Answered {
    Time time;
    process_report_t answer;
    std::optional<int> starts_before = std::nullopt;  ///< of a process that is not known to be ready again
  };
  bool IsMine(const process_order_t& order) const;
  const Answered* AnswerTo(const process_order_t& order) const;
  static std::optional<process_report_t> AnswerOf(const Answered& taken);
  void Obey(const process_order_t& order, Time now, Answered& taken);
  void Restart(Answered& taken);
  void Tell(const process_order_t& order, process_report_t& answer) const;
  bool TooOften(const std::string& name, Time now);

  Hands hands_;
  std::deque<Answered> answered_;      ///< or to be answered; oldest first
  std::map<std::string, Time> begun_;  ///< when a process, or the world as "", was last started by an order
};

}  // namespace priamos::cli
