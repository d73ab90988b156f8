#include "cli/options/bus_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>

#include "bus/own_types.hpp"
#include "bus/type_files.hpp"
#include "common/nearest_word.hpp"

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

void AddChannelArgument(CLI::App& verb, std::string& channel) {
  verb.add_option("channel", channel, "LCM channel")->required();
}

bus::Schema LoadTypes(const BusOptions& options) {
  return LoadTypes(options.types);
}

bus::Schema LoadTypes(const std::string& folder) {
  return folder.empty() ? bus::OwnTypes() : bus::Schema(bus::ReadTypeFiles(folder));
}

bus::SchemaError UnknownType(const bus::Schema& schema, const std::string& name) {
  std::vector<std::string> known;
  for (const auto* type : schema.All())
    known.push_back(name.find('.') == std::string::npos ? type->name : type->full_name);
  return bus::SchemaError(
      fmt::format("unknown type \"{}\"{} (priamos type hash lists all)", name, NearestText(name, known)));
}

}  // namespace priamos::cli
