#include "bus/parameters/parameter_json.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

namespace priamos::bus {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<std::string_view, LiveChange>, 3> kChanges{
    {{"any", LiveChange::kInRange}, {"lower", LiveChange::kOnlyLower}, {"higher", LiveChange::kOnlyHigher}}};

std::string_view NameOf(LiveChange change) {
  for (const auto& [name, known] : kChanges)
    if (known == change) return name;
  return "any";
}

/// One that is not known is taken for `any`: the fingerprint then differs.
LiveChange ChangeOf(std::string_view word) {
  for (const auto& [name, change] : kChanges)
    if (name == word) return change;
  return LiveChange::kInRange;
}

Parameter ParameterOf(const Json& json) {
  return {json.at("name"), json.at("unit"), json.at("meaning"),
          json.at("min"),  json.at("max"),  ChangeOf(json.at("change").get<std::string>())};
}

}  // namespace

std::string ToJson(const ParameterSheet& sheet) {
  Json json{{"table", sheet.table.Fingerprint()}, {"parameters", Json::array()}};
  for (std::size_t i = 0; i < sheet.table.all().size(); ++i) {
    const Parameter& p = sheet.table.all()[i];
    json["parameters"].push_back({{"name", p.name},
                                  {"unit", p.unit},
                                  {"min", p.min},
                                  {"max", p.max},
                                  {"change", NameOf(p.change)},
                                  {"value", sheet.values.at(i)},
                                  {"meaning", p.meaning}});
  }
  return json.dump();
}

Outcome<ParameterSheet> ParameterSheetOf(std::string_view json) {
  try {
    const Json object = Json::parse(json);
    std::vector<Parameter> parameters;
    std::vector<double> values;
    for (const Json& parameter : object.at("parameters")) {
      parameters.push_back(ParameterOf(parameter));
      values.push_back(parameter.at("value"));
    }
    ParameterSheet sheet{ParameterTable(std::move(parameters)), std::move(values)};
    if (sheet.table.Fingerprint() != object.at("table").get<int>())
      return Refusal{"the program is of another version: what it says of its parameters has other marks"};
    return sheet;
  } catch (const Json::exception&) {
    return Refusal{"the program says nothing of parameters"};
  }
}

}  // namespace priamos::bus
