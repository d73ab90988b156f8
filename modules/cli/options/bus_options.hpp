#pragma once

#include <string>
#include <vector>

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
  std::vector<std::string> types;  ///< folders of .lcm files; none: our own
  bool fragments = false;

  bus::LcmBus::Messages messages() const {
    return fragments ? bus::LcmBus::Messages::kAnySize : bus::LcmBus::Messages::kParametric;
  }
};

void AddBusOption(CLI::App& verb, BusOptions& options);
/// Adds --types, which may be given several times.
void AddTypesOption(CLI::App& verb, std::vector<std::string>& folders);

/// The channel that a verb is about, its first argument. `channel` must outlive `verb`.
void AddChannelArgument(CLI::App& verb, std::string& channel);

/// The types of these folders and those below them; our own without a folder. Each type that cannot be used
/// is named once, on standard error, and the others are there. Throws SchemaError when none can be used.
bus::Schema LoadTypes(const std::vector<std::string>& folders);

/// What to throw for a `name` that `schema` does not have: it names the nearest ones, unless a type of that
/// name was refused.
bus::SchemaError UnknownType(const bus::Schema& schema, const std::string& name);

}  // namespace priamos::cli
