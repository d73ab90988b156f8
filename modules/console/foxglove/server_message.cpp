#include "console/foxglove/server_message.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "console/core/json_line.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint8_t kMessageData = 0x01, kTime = 0x02, kServiceAnswer = 0x03;
constexpr int kWarning = 1;
constexpr const char* kAnswerSchema =
    R"({"title":"done","type":"object","properties":{"done":{"type":"boolean"}}})";

template <class T>
void Put(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

void PutTime(std::string& bytes, Time time) {
  Put(bytes, static_cast<std::uint64_t>(std::max<std::int64_t>(ToUtime(time), 0)) * 1000);
}

Json DescriptionOf(std::string_view name, std::string_view schema) {
  return {{"encoding", "json"}, {"schemaName", name}, {"schemaEncoding", "jsonschema"}, {"schema", schema}};
}

}  // namespace

std::string ServerInfo(std::string_view name, std::string_view session, bool parameters) {
  Json capabilities = {"time", "services"};
  if (parameters) capabilities.insert(capabilities.end(), {"parameters", "parametersSubscribe"});
  return JsonLine({{"op", "serverInfo"},
                   {"name", name},
                   {"capabilities", std::move(capabilities)},
                   {"supportedEncodings", {"json"}},
                   {"metadata", Json::object()},
                   {"sessionId", session}});
}

std::string AdvertiseText(std::uint32_t first, std::span<const OfferedChannel> channels) {
  Json list = Json::array();
  for (const OfferedChannel& channel : channels) {
    Json one = {{"id", first++}, {"topic", channel.topic}};
    one.update(DescriptionOf(channel.schema_name, channel.schema));
    list.push_back(std::move(one));
  }
  return JsonLine({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string AdvertiseServicesText(std::span<const OfferedService> services) {
  Json list = Json::array();
  std::uint32_t id = 0;
  for (const OfferedService& service : services)
    list.push_back({{"id", ++id},
                    {"name", service.name},
                    {"type", service.name},
                    {"request", DescriptionOf(service.name, service.request_schema)},
                    {"response", DescriptionOf("done", kAnswerSchema)}});
  return JsonLine({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string ParameterValuesText(std::span<const ShownParameter> parameters, std::string_view id) {
  Json list = Json::array();
  for (const ShownParameter& parameter : parameters)
    list.push_back({{"name", parameter.name}, {"value", parameter.value}, {"type", "float64"}});
  Json text = {{"op", "parameterValues"}, {"parameters", std::move(list)}};
  if (!id.empty()) text["id"] = id;
  return JsonLine(text);
}

std::string WarningText(std::string_view sentence) {
  return JsonLine({{"op", "status"}, {"level", kWarning}, {"message", sentence}});
}

std::string CallFailureText(std::uint32_t service, std::uint32_t call, std::string_view reason) {
  return JsonLine(
      {{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", reason}});
}

std::string MessageBytes(std::uint32_t subscription, Time time, std::string_view payload) {
  std::string bytes;
  bytes.reserve(13 + payload.size());
  Put(bytes, kMessageData);
  Put(bytes, subscription);
  PutTime(bytes, time);
  return bytes.append(payload);
}

std::string TimeBytes(Time now) {
  std::string bytes;
  Put(bytes, kTime);
  PutTime(bytes, now);
  return bytes;
}

std::string CallAnswerBytes(std::uint32_t service, std::uint32_t call, std::string_view json) {
  constexpr std::string_view kEncoding = "json";
  std::string bytes;
  Put(bytes, kServiceAnswer);
  Put(bytes, service);
  Put(bytes, call);
  Put(bytes, static_cast<std::uint32_t>(kEncoding.size()));
  return bytes.append(kEncoding).append(json);
}

}  // namespace priamos::console
