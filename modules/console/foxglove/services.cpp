#include "console/foxglove/services.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "console/core/json_line.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestCall = 900;

/// A service, the fields of the page's message that it stands for, and the fields that a call gives.
struct Service {
  const char* name;
  const char* page_message;
  std::vector<std::pair<const char*, const char*>> fields;  ///< name, type of JSON schema
};

const std::vector<Service>& All() {
  static const std::vector<Service> kAll{
      {"stop", R"({"type":"stop"})", {}},
      {"mission/abort", R"({"type":"mission","order":"abort"})", {}},
      {"mission/pass_door", R"({"type":"mission","order":"pass_door"})", {{"landmark", "integer"}}},
      {"mission/goto",
       R"({"type":"mission","order":"goto"})",
       {{"x_m", "number"}, {"y_m", "number"}, {"yaw_rad", "number"}, {"turn", "boolean"}}},
      {"mission/corridor",
       R"({"type":"mission","order":"corridor"})",
       {{"distance_m", "number"}, {"yaw_rad", "number"}, {"turn", "boolean"}}},
      {"mission/explore", R"({"type":"mission","order":"explore"})", {}},
      {"mission/locate", R"({"type":"mission","order":"locate"})", {}},
      {"mission/patrol",
       R"({"type":"mission","order":"patrol"})",
       {{"places", "array"}, {"rounds", "integer"}}},
      {"mission/pause", R"({"type":"mission","order":"pause"})", {}},
      {"mission/resume", R"({"type":"mission","order":"resume"})", {}},
      {"mission/cancel", R"({"type":"mission","order":"cancel"})", {{"number", "integer"}}},
      {"place", R"({"type":"place"})", {{"x_m", "number"}, {"y_m", "number"}, {"yaw_rad", "number"}}},
  };
  return kAll;
}

std::string RequestSchema(const Service& service) {
  Json schema = {{"title", service.name}, {"type", "object"}, {"properties", Json::object()}};
  for (const auto& [field, type] : service.fields) schema["properties"][field] = {{"type", type}};
  return schema.dump();
}

}  // namespace

std::vector<OfferedService> Services() {
  std::vector<OfferedService> services;
  for (const Service& service : All()) services.push_back({service.name, RequestSchema(service)});
  return services;
}

Outcome<std::string> PageMessageOf(std::uint32_t service, std::string_view json) {
  if (service < 1 || service > All().size()) return Refusal{"there is no such service"};
  if (json.size() > kLongestCall) return Refusal{fmt::format("expected at most {} bytes", kLongestCall)};
  const Json fields = json.empty() ? Json::object() : Json::parse(json, nullptr, false);
  if (!fields.is_object()) return Refusal{"expected a JSON object"};
  Json message = Json::parse(All()[service - 1].page_message);
  for (const auto& [key, value] : fields.items()) {
    if (message.contains(key)) return Refusal{fmt::format("key \"{}\" is the service's own", key)};
    message[key] = value;
  }
  return JsonLine(message);
}

}  // namespace priamos::console
