#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/walk.hpp"
#include "fuzz_input.hpp"

namespace priamos::bus {
namespace {

/// Any message has a JSON form that means the same.
void MessageToJsonAndBack(const Struct& type, std::span<const std::byte> message) {
  if (!Walk(type, message)) return;
  const Json json = ToJson(type, message);
  Require(ToJson(type, FromJson(type, Json::parse(json.dump()))) == json);
}

/// Any text is refused by MessageError or gives a message.
void TextToMessage(const Struct& type, std::span<const std::byte> text) {
  const auto* first = reinterpret_cast<const char*>(text.data());
  const Json json = Json::parse(first, first + text.size(), nullptr, false);
  if (json.is_discarded()) return;
  try {
    Require(static_cast<bool>(Walk(type, FromJson(type, json))));
  } catch (const MessageError&) {
  }
}

}  // namespace
}  // namespace priamos::bus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus;
  const TypedInput input = SplitInput(data, size);
  MessageToJsonAndBack(*input.type, WithFingerprint(*input.type, input.rest));
  TextToMessage(*input.type, input.rest);
  return 0;
}
