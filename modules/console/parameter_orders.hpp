#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "bus/parameters/parameter_json.hpp"
#include "bus/parameters/parameter_messages.hpp"
#include "common/pilot/repeated_order.hpp"
#include "console/core/browser_message.hpp"

namespace priamos::console {

/// Gives what pages wish of parameters to the processes: one order at a time, again until it is answered, for
/// the radio carries the newest one only. Pure: time is an argument.
class ParameterOrders {
 public:
  static constexpr std::size_t kMostWaiting = 16;

  /// What a process says of its parameters; before it has said so no wish is taken.
  void Know(const std::string& process, const ParameterTable& table);
  /// Takes a wish; false for a process or key that is not known, and when too many wait. A wish that waits
  /// already does not wait twice; of values for one key the newest counts.
  bool Wish(const ParameterWish& wish);
  void Answered(const parameter_value_t& answer) { open_.Answered(answer.request_id); }
  /// The order to send now, if there is one.
  std::optional<parameter_order_t> Step(Time now);

 private:
  struct Known {
    std::int8_t process;
    ParameterTable table;
  };
  std::map<std::string, Known> known_;
  std::deque<ParameterWish> waiting_;
  RepeatedOrder<parameter_order_t> open_;
};

}  // namespace priamos::console
