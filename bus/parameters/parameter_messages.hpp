#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/parameters/parameter_store.hpp"
#include "common/time.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

/// The constant of parameter_order_t for a process; nullopt for one that obeys no such orders.
std::optional<std::int8_t> ParameterProcess(std::string_view name);
/// The process of such a constant; empty for another number.
std::string_view ProcessOfParameters(int process);

/// An order to a process.
struct ParameterOrder {
  std::int8_t process = 0;
  std::int8_t action = parameter_order_t::READ;
  int key = 0;
  double value = 0;
};

parameter_order_t ToMessage(const ParameterOrder& order, const ParameterTable& table, Time now);

/// The constant of parameter_value_t for what became of a change.
std::int8_t ToOutcome(ChangeVerdict verdict);
/// What an outcome means, as a person reads it.
std::string_view OutcomeText(int outcome);

/// A value that has come over the radio, rounded to what was sent.
double RoundedParameter(double value);

}  // namespace priamos::bus
