#include "bus/parameters/parameter_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bus/parameters/parameter_messages.hpp"
#include "common/parameters/saved_parameters.hpp"

namespace priamos::bus {
namespace {

using Order = parameter_order_t;
using Value = parameter_value_t;

// The radio restores times to a few milliseconds.
constexpr Duration kAheadAllowed = std::chrono::seconds(1);

}  // namespace

ParameterDesk::ParameterDesk(std::int8_t process, ParameterStore& store, Surroundings surroundings)
    : process_(process), store_(store), around_(std::move(surroundings)), saved_(store.Changed()) {}

std::optional<parameter_value_t> ParameterDesk::Take(const parameter_order_t& order, Time now) {
  if (order.process != process_) return std::nullopt;
  while (!answered_.empty() && now - answered_.front().time > kOldest) answered_.pop_front();
  if (const parameter_value_t* answer = AnswerTo(order.request_id)) return *answer;
  if (answered_.size() >= kMostOrders) {
    ++refused_;
    return std::nullopt;
  }
  parameter_value_t answer{};
  answer.outcome = Obey(order, now);
  if (answer.outcome != Value::DONE) ++refused_;
  answer.utime = ToUtime(now);
  answer.request_id = order.request_id;
  answer.process = process_;
  answer.table = store_.table().Fingerprint();
  const bool known = answer.outcome != Value::OTHER_TABLE && store_.table().Find(order.key) != nullptr;
  answer.key = known ? order.key : std::int16_t{0};
  answer.value = known ? store_.ValueOf(order.key) : 0;
  answer.next_changed = static_cast<std::int16_t>(store_.NextChanged(answer.key));
  answer.unsaved = store_.Changed() != saved_;
  answered_.push_back({now, answer});
  return answer;
}

const parameter_value_t* ParameterDesk::AnswerTo(int request_id) const {
  const auto at = std::find_if(answered_.begin(), answered_.end(),
                               [&](const Answered& a) { return a.answer.request_id == request_id; });
  return at == answered_.end() ? nullptr : &at->answer;
}

std::int8_t ParameterDesk::Obey(const parameter_order_t& order, Time now) {
  const Duration age = now - FromUtime(order.utime);
  if (age > kOldest || age < -kAheadAllowed) return Value::TOO_OLD;
  if (order.table != store_.table().Fingerprint()) return Value::OTHER_TABLE;
  switch (order.action) {
    case Order::READ:
      return order.key == 0 || store_.table().Find(order.key) != nullptr ? Value::DONE : Value::UNKNOWN_KEY;
    case Order::SET:
      return Set(order.key, RoundedParameter(order.value));
    case Order::SAVE:
      return Save();
    case Order::RESET:
      return Reset();
    default:
      return Value::UNKNOWN_ACTION;
  }
}

std::int8_t ParameterDesk::Set(int key, double value) {
  const Parameter* parameter = store_.table().Find(key);
  const double before = parameter != nullptr ? store_.ValueOf(key) : 0;
  const ChangeVerdict verdict = store_.Set(key, value);
  if (verdict == ChangeVerdict::kDone) {
    around_.note(false, fmt::format("{}: {} -> {} {}", parameter->name, before, value, parameter->unit));
    around_.changed();
  } else {
    around_.note(true, fmt::format("{} not set to {}: {}", parameter != nullptr ? parameter->name : "a key",
                                   value, Text(verdict)));
  }
  return ToOutcome(verdict);
}

std::int8_t ParameterDesk::Save() {
  if (const std::string why = SaveParameters(around_.saved, store_); !why.empty()) {
    around_.note(true, fmt::format("parameters not saved: {}", why));
    return Value::NOT_SAVED;
  }
  saved_ = store_.Changed();
  around_.note(false, fmt::format("parameters saved: {} differ from the file", saved_.size()));
  return Value::DONE;
}

/// Without a file of saved ones there is nothing to forget.
std::int8_t ParameterDesk::Reset() {
  store_.Reset();
  around_.changed();
  around_.note(false, "parameters are the file's again");
  return around_.saved.empty() ? std::int8_t{Value::DONE} : Save();
}

}  // namespace priamos::bus
