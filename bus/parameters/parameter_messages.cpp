#include "bus/parameters/parameter_messages.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace priamos::bus {
namespace {

using Order = parameter_order_t;
using Value = parameter_value_t;

constexpr std::array<std::pair<std::string_view, std::int8_t>, 3> kProcesses{
    {{"robot", Order::ROBOT}, {"head", Order::HEAD}, {"planner", Order::PLANNER}}};
constexpr std::int64_t kRequestIds = 65535;
constexpr double kSteps = 1e6;  ///< of a value, per unit: see parameter_order_t

}  // namespace

std::optional<std::int8_t> ParameterProcess(std::string_view name) {
  for (const auto& [process, number] : kProcesses)
    if (process == name) return number;
  return std::nullopt;
}

std::string_view ProcessOfParameters(int process) {
  for (const auto& [name, number] : kProcesses)
    if (number == process) return name;
  return "";
}

parameter_order_t ToMessage(const ParameterOrder& order, const ParameterTable& table, Time now) {
  parameter_order_t message{};
  message.utime = ToUtime(now);
  message.request_id = static_cast<std::int32_t>(1 + message.utime / 1000 % kRequestIds);
  message.process = order.process;
  message.action = order.action;
  message.table = table.Fingerprint();
  message.key = static_cast<std::int16_t>(order.key);
  message.value = order.value;
  return message;
}

std::int8_t ToOutcome(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::kDone:
      return Value::DONE;
    case ChangeVerdict::kUnknownKey:
      return Value::UNKNOWN_KEY;
    case ChangeVerdict::kOutOfRange:
      return Value::OUT_OF_RANGE;
    case ChangeVerdict::kLessCareful:
      return Value::LESS_CAREFUL;
    case ChangeVerdict::kContradicts:
      return Value::CONTRADICTS;
  }
  return Value::UNKNOWN_KEY;
}

std::string_view OutcomeText(int outcome) {
  switch (outcome) {
    case Value::DONE:
      return Text(ChangeVerdict::kDone);
    case Value::UNKNOWN_KEY:
      return Text(ChangeVerdict::kUnknownKey);
    case Value::OUT_OF_RANGE:
      return Text(ChangeVerdict::kOutOfRange);
    case Value::LESS_CAREFUL:
      return Text(ChangeVerdict::kLessCareful);
    case Value::CONTRADICTS:
      return Text(ChangeVerdict::kContradicts);
    case Value::OTHER_TABLE:
      return "the process has other parameters: it is of another version; next: install the same on both";
    case Value::TOO_OLD:
      return "the order came too late; next: give it again";
    case Value::NOT_SAVED:
      return "the file could not be written, or the process was started without --saved FILE; its log says "
             "which";
    case Value::UNKNOWN_ACTION:
      return "the process knows no such order: it is of another version";
    default:
      return "an answer of another version";
  }
}

double RoundedParameter(double value) {
  return std::round(value * kSteps) / kSteps;
}

}  // namespace priamos::bus
