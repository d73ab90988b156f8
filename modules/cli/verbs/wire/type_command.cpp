#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/schema/json_schema.hpp"
#include "bus/schema/packing.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/wire/channel_table.hpp"
#include "cli/verbs/wire/commands.hpp"

namespace priamos::cli {
namespace {

struct TypeOptions : BusOptions {
  std::string type;
  bool json = false;
};

const bus::Struct& Find(const bus::Schema& schema, const std::string& name) {
  if (const auto* type = schema.Find(std::string_view(name))) return *type;
  throw UnknownType(schema, name);
}

std::string Dimensions(const bus::Field& field) {
  std::string text;
  for (const auto& d : field.dims) text += "[" + d.text + "]";
  return text;
}

std::optional<std::size_t> PackedBytes(const bus::Struct& type) {
  try {
    return bus::Packer(type).MaxBytes();
  } catch (const bus::SchemaError&) {  // not annotated: the radio cannot carry it
    return std::nullopt;
  }
}

std::string Bytes(const std::optional<std::size_t>& bytes) {
  return bytes ? fmt::format("at most {} bytes", *bytes) : "of no bounded size";
}

void PrintType(const bus::Struct& type) {
  std::cout << fmt::format("{}  0x{:016x}  ({}:{})\n", type.full_name, type.fingerprint, type.file,
                           type.line);
  if (!type.doc.empty()) std::cout << type.doc << "\n";
  std::cout << fmt::format("on LCM {}; packed {}\n", Bytes(bus::MaxEncodedSize(type)),
                           Bytes(PackedBytes(type)));
  for (const auto& c : type.constants)
    std::cout << fmt::format("  const {} {} = {}\n", bus::KindName(c.kind), c.name, c.text);
  for (const auto& f : type.fields)
    std::cout << fmt::format("  {:<24} {:<28} {}\n", f.type_name, f.name + Dimensions(f), f.comment);
}

int Show(const TypeOptions& options) {
  const bus::Schema schema = LoadTypes(options.types);
  const bus::Struct& type = Find(schema, options.type);
  if (options.json) {
    std::cout << bus::JsonSchemaOf(type).dump(2) << "\n";
  } else {
    PrintType(type);
  }
  return 0;
}

int Hash(const TypeOptions& options) {
  const bus::Schema schema = LoadTypes(options.types);
  const auto types = options.type.empty() ? schema.All() : std::vector{&Find(schema, options.type)};
  auto json = nlohmann::ordered_json::object();
  for (const auto* type : types) {
    const std::string hash = fmt::format("0x{:016x}", type->fingerprint);
    json[type->full_name] = hash;
    if (!options.json) std::cout << hash << "  " << type->full_name << "\n";
  }
  if (options.json) std::cout << json.dump() << "\n";
  return 0;
}

}  // namespace

void AddTypeCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<TypeOptions>();
  auto* type = AddVerb(cli, "type", "Message types, ours or those of any folder of .lcm files.");
  type->require_subcommand(1);
  auto* show = AddVerb(*type, "show", "A type with every field: unit, range, meaning, sizes.");
  show->footer("Example: priamos type show pose_t\n         priamos type show my_t --types ~/their/lcmtypes");
  show->add_option("type", options->type, "message type")->required();
  show->add_flag("--json", options->json, "print a JSON schema");
  show->callback([options, &exit_code] { exit_code = Show(*options); });
  auto* hash = AddVerb(*type, "hash", "LCM's fingerprint of a type, or of all; equal to lcm-gen's.");
  hash->footer("Example: priamos type hash pose_t");
  hash->add_option("type", options->type, "message type; none: all");
  hash->add_flag("--json", options->json, "machine-readable");
  hash->callback([options, &exit_code] { exit_code = Hash(*options); });
  auto* table = AddVerb(*type, "channels", "Every channel of PRIAMOS: type, rate, life span, sizes.");
  table->footer("Example: priamos type channels");
  table->add_flag("--json", options->json, "machine-readable");
  table->callback([options, &exit_code] {
    std::cout << (options->json ? ChannelsAsJson() + "\n" : ChannelTable());
    exit_code = 0;
  });
  for (auto* verb : {show, hash}) AddTypesOption(*verb, options->types);
}

}  // namespace priamos::cli
