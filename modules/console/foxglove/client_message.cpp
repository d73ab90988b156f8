#include "console/foxglove/client_message.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "console/core/read_json.hpp"

namespace priamos::console {
namespace {

using nlohmann::json;

constexpr char kClientData = 0x01, kServiceCall = 0x02;
constexpr std::size_t kMostItems = 1000, kLongestWord = 64, kLongestName = 200;

const json& ListIn(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || !it->is_array() || it->size() > kMostItems)
    throw Wrong(fmt::format("{}: expected a list of at most {} items", key, kMostItems));
  return *it;
}

std::uint32_t NumberIn(const json& value, const char* name) {
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost)
    throw Wrong(fmt::format("{}: expected a whole number from 0 to {}", name, kMost));
  return value.get<std::uint32_t>();
}

std::uint32_t NumberOf(const json& object, const char* key) {
  const auto it = object.is_object() ? object.find(key) : object.end();
  return NumberIn(it == object.end() ? json() : *it, key);
}

/// A text of an object; empty when it has none of this name.
std::string WordIn(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || it->is_null()) return "";
  if (!it->is_string() || it->get_ref<const std::string&>().size() > kLongestName)
    throw Wrong(fmt::format("{}: expected a text of at most {} bytes", key, kLongestName));
  return it->get<std::string>();
}

std::vector<std::string> NamesIn(const json& object) {
  std::vector<std::string> names;
  if (!object.contains("parameterNames")) return names;
  for (const json& name : ListIn(object, "parameterNames"))
    names.push_back(WordIn({{"parameterNames", name}}, "parameterNames"));
  return names;
}

SetParametersRequest ReadChanges(const json& object) {
  SetParametersRequest request{{}, WordIn(object, "id")};
  for (const json& change : ListIn(object, "parameters")) {
    if (!change.is_object()) throw Wrong("parameters: expected objects");
    const auto value = change.find("value");
    const bool number = value != change.end() && value->is_number();
    request.changes.push_back(
        {WordIn(change, "name"), number ? std::optional(value->get<double>()) : std::nullopt});
  }
  return request;
}

ClientMessage ReadObject(const json& object) {
  const auto op = object.is_object() ? object.find("op") : object.end();
  if (!object.is_object() || op == object.end() || !op->is_string() ||
      op->get_ref<const std::string&>().size() > kLongestWord)
    throw Wrong("op: expected the name of an operation");
  if (*op == "subscribe") {
    SubscribeRequest request;
    for (const json& wish : ListIn(object, "subscriptions"))
      request.wishes.push_back({NumberOf(wish, "id"), NumberOf(wish, "channelId")});
    return request;
  }
  if (*op == "unsubscribe") {
    UnsubscribeRequest request;
    for (const json& id : ListIn(object, "subscriptionIds"))
      request.subscriptions.push_back(NumberIn(id, "subscriptionIds"));
    return request;
  }
  if (*op == "getParameters") return GetParametersRequest{NamesIn(object), WordIn(object, "id")};
  if (*op == "setParameters") return ReadChanges(object);
  if (*op == "subscribeParameterUpdates") return WatchParametersRequest{NamesIn(object), true};
  if (*op == "unsubscribeParameterUpdates") return WatchParametersRequest{NamesIn(object), false};
  return OtherRequest{op->get<std::string>()};
}

/// Takes numbers and texts from the front of bytes; nullopt when they are too short.
class Bytes {
 public:
  explicit Bytes(std::string_view left) : left_(left) {}

  std::optional<std::uint32_t> Number() {
    const auto text = Text(4);
    if (!text) return std::nullopt;
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>((*text)[std::size_t(i)]);
    return value;
  }
  std::optional<std::string_view> Text(std::size_t size) {
    if (left_.size() < size) return std::nullopt;
    const auto text = left_.substr(0, size);
    left_.remove_prefix(size);
    return text;
  }
  std::string_view left() const { return left_; }

 private:
  std::string_view left_;
};

Outcome<ClientMessage> ReadCall(std::string_view body) {
  Bytes bytes(body);
  const auto service = bytes.Number(), call = bytes.Number(), length = bytes.Number();
  const auto encoding = length && *length <= kLongestWord ? bytes.Text(*length) : std::nullopt;
  if (!encoding) return Refusal{"expected a call of a service: its number, the call's, and an encoding"};
  return ClientMessage(ServiceRequest{*service, *call, std::string(*encoding), std::string(bytes.left())});
}

}  // namespace

Outcome<ClientMessage> ReadClientText(std::string_view text) {
  return ReadJson<ClientMessage>(text, kMaxClientMessage, ReadObject);
}

Outcome<ClientMessage> ReadClientBytes(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > kMaxClientMessage)
    return Refusal{fmt::format("expected 1 to {} bytes, got {}", kMaxClientMessage, bytes.size())};
  if (bytes.front() == kServiceCall) return ReadCall(bytes.substr(1));
  if (bytes.front() == kClientData) return ClientMessage(OtherRequest{"publish"});
  return Refusal{fmt::format("expected 1 or 2 as the first byte, got {}", int(bytes.front()))};
}

}  // namespace priamos::console
