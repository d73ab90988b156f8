#pragma once

#include <string>

#include "bus/bus_choice.hpp"
#include "bus/schema/schema.hpp"
#include "bus/wire/lcm_bus.hpp"

namespace CLI {
class App;
}

namespace priamos::cli {

/// What every verb that looks at a bus or a log shares.
struct BusOptions {
  bus::BusChoice bus;
  std::string types;  ///< folder of .lcm files; empty: our own
  bool fragments = false;

  bus::LcmBus::Messages messages() const {
    return fragments ? bus::LcmBus::Messages::kAnySize : bus::LcmBus::Messages::kParametric;
  }
};

void AddBusOption(CLI::App& verb, BusOptions& options);
void AddTypesOption(CLI::App& verb, BusOptions& options);

/// The channel that a verb is about, its first argument. `channel` must outlive `verb`.
void AddChannelArgument(CLI::App& verb, std::string& channel);

/// The types named by --types, or our own. Throws SchemaError.
bus::Schema LoadTypes(const BusOptions& options);
bus::Schema LoadTypes(const std::string& folder);

/// What to throw for a `name` that `schema` does not have: it names the nearest ones.
bus::SchemaError UnknownType(const bus::Schema& schema, const std::string& name);

}  // namespace priamos::cli
