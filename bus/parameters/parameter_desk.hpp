#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "common/parameters/parameter_store.hpp"
#include "common/time.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

/// Obeys parameter_order_t for one process. An order is obeyed once: a repetition, also one that somebody
/// plays back, gets the answer of the first time again; one of more than kOldest is refused.
class ParameterDesk {
 public:
  static constexpr Duration kOldest = std::chrono::seconds(10);
  /// Orders that are obeyed within kOldest; of a flood the others are counted as refused, and not answered.
  static constexpr std::size_t kMostOrders = 100;

  /// What the desk works with. `changed` is called after values have changed, `note` with a sentence for the
  /// log.
  struct Surroundings {
    std::string saved;  ///< file of saved parameters; empty: there is none
    std::function<void()> changed;
    std::function<void(bool warning, std::string_view)> note;
  };

  ParameterDesk(std::int8_t process, ParameterStore& store, Surroundings surroundings);

  /// The answer; nullopt when the order is for another process, or is one of a flood.
  std::optional<parameter_value_t> Take(const parameter_order_t& order, Time now);
  std::uint64_t refused() const { return refused_; }

 private:
  struct Answered {
    Time time;
    parameter_value_t answer;
  };
  const parameter_value_t* AnswerTo(int request_id) const;
  std::int8_t Obey(const parameter_order_t& order, Time now);
  std::int8_t Set(int key, double value);
  std::int8_t Save();
  std::int8_t Reset();

  std::int8_t process_;
  ParameterStore& store_;
  Surroundings around_;
  std::vector<std::pair<std::string, double>> saved_;  ///< what the next start would take
  std::deque<Answered> answered_;                      ///< oldest first
  std::uint64_t refused_ = 0;
};

}  // namespace priamos::bus
