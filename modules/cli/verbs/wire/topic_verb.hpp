#pragma once

#include <CLI/App.hpp>
#include <string>

#include "cli/options/bus_options.hpp"
#include "cli/options/verb_setup.hpp"

namespace priamos::cli {

/// A new verb of `topic` with the options of a bus and of its types. `options` are the verb's own: CLI11
/// fills in what $PRIAMOS_BUS says for every verb that was not typed, and would overwrite the --bus of the
/// one that was.
inline CLI::App* AddTopicVerb(CLI::App& topic, const char* name, const char* help, const char* example,
                              BusOptions& options) {
  auto* verb = AddVerb(topic, name, help);
  verb->footer(std::string("Example: ") + example);
  AddBusOption(*verb, options);
  AddTypesOption(*verb, options.types);
  return verb;
}

}  // namespace priamos::cli
