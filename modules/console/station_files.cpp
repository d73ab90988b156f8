#include "console/station_files.hpp"

#include <nlohmann/json.hpp>

#include "bus/schema/fingerprint.hpp"
#include "bus/schema/json_schema.hpp"
#include "bus/schema/schema.hpp"
#include "console/page_files.hpp"

namespace priamos::console {
namespace {

constexpr std::string_view kJson = "application/json";
/// Of a process that lets nothing be changed.
constexpr const char* kNoneLive = R"({"table":0,"parameters":[]})";

}  // namespace

StationFiles::StationFiles(const bus::Schema& schema) : files_(PageFiles()) {
  for (const bus::Struct* type : schema.All()) {
    if (bus::ReachesRecursion(*type)) continue;  // it contains itself: no schema can be written out
    Add("/types/" + type->full_name + ".json", kJson, bus::JsonSchemaOf(*type).dump());
  }
}

void StationFiles::AddParameters(const ParameterSheets& sheets) {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& [name, sheet] : sheets) {
    names.push_back(name);
    Add("/parameters/" + name + ".toml", "text/plain; charset=utf-8", sheet.text);
    Add("/parameters/" + name + ".json", kJson, sheet.live ? bus::ToJson(*sheet.live) : kNoneLive);
  }
  Add("/parameters/index.json", kJson, names.dump());
}

void StationFiles::Add(const std::string& target, std::string_view type, std::string text) {
  texts_.push_back(std::move(text));
  files_[target] = {type, texts_.back()};
}

}  // namespace priamos::console
