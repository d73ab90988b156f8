#include "cli/options/bus_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>

#include "bus/own_types.hpp"
#include "bus/type_files.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {

void AddBusOption(CLI::App& verb, BusOptions& options) {
  bus::AddBusChoice(verb, options.bus);
  verb.add_flag("--fragments", options.fragments,
                "a foreign bus with messages of any size, which come in fragments: no socket filter");
}

void AddTypesOption(CLI::App& verb, std::vector<std::string>& folders) {
  verb.add_option(
          "--types", folders,
          "folder of .lcm files, also in folders below it; may be given again; none: PRIAMOS's own types")
      ->allow_extra_args(false)  // or it would take the words behind it for folders
      ->check(CLI::ExistingDirectory);
}

void AddChannelArgument(CLI::App& verb, std::string& channel) {
  verb.add_option("channel", channel, "LCM channel")->required();
}

bus::Schema LoadTypes(const std::vector<std::string>& folders) {
  if (folders.empty()) return bus::OwnTypes();
  std::vector<std::string> problems;
  const auto sources = bus::ReadTypeFolders(folders, problems);
  bus::Schema schema(sources, problems);
  if (schema.All().empty() && problems.size() == 1) throw bus::SchemaError(problems.front());
  for (const std::string& problem : problems) std::cerr << problem << "\n";
  if (schema.All().empty() && !problems.empty())
    throw bus::SchemaError("--types: expected types that can be used, got none; the reasons stand above");
  return schema;
}

bus::SchemaError UnknownType(const bus::Schema& schema, const std::string& name) {
  if (schema.Refused(name))
    return bus::SchemaError(
        fmt::format("expected a type that can be used, got \"{}\"; the reason stands above", name));
  std::vector<std::string> known;
  for (const auto* type : schema.All())
    known.push_back(name.find('.') == std::string::npos ? type->name : type->full_name);
  return bus::SchemaError(
      fmt::format("unknown type \"{}\"{} (priamos type hash lists all)", name, NearestText(name, known)));
}

}  // namespace priamos::cli
