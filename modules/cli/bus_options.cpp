#include "cli/bus_options.hpp"

#include <CLI/CLI.hpp>

#include "bus/own_types.hpp"

namespace priamos::cli {

void AddBusOption(CLI::App& verb, BusOptions& options) {
  bus::AddBusChoice(verb, options.bus);
  verb.add_flag("--fragments", options.fragments,
                "a foreign bus with messages of any size, which come in fragments: no socket filter");
}

void AddTypesOption(CLI::App& verb, BusOptions& options) {
  verb.add_option("--types", options.types, "folder of .lcm files; none: PRIAMOS's own types")
      ->check(CLI::ExistingDirectory);
}

bus::Schema LoadTypes(const BusOptions& options) {
  return options.types.empty() ? bus::OwnTypes() : bus::Schema(bus::Schema::ReadDirectory(options.types));
}

}  // namespace priamos::cli
