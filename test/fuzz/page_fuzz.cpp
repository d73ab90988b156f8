#include <cstdint>
#include <string_view>

#include "common/web/web_request.hpp"
#include "console/core/browser_message.hpp"
#include "console/foxglove/client_message.hpp"
#include "console/foxglove/services.hpp"
#include "fuzz_input.hpp"

namespace priamos::console {
namespace {

/// Any text is refused by a sentence or gives a message whose numbers are in range.
void ReadAnyMessage(std::string_view text) {
  const auto message = ReadBrowserMessage(text);
  bus::Require(static_cast<bool>(message) == message.reason().empty());
  if (!message) return;
  if (const auto* report = std::get_if<StickReport>(&*message))
    for (const double v : report->axis) bus::Require(v >= -1 && v <= 1);
}

/// What Foxglove clients say: any text and any bytes are refused by a sentence or read, and a call becomes no
/// message of a page that is not its service's own.
void ReadAnyClientMessage(std::string_view text) {
  for (const auto& message : {ReadClientText(text), ReadClientBytes(text)})
    bus::Require(static_cast<bool>(message) == message.reason().empty());
  for (std::uint32_t service = 0; service <= Services().size() + 1; ++service) {
    const auto order = PageMessageOf(service, text);
    const auto message = order ? ReadBrowserMessage(*order) : Outcome<BrowserMessage>(Refusal{"none"});
    if (!message) continue;
    bus::Require(std::holds_alternative<StopOrder>(*message) ||
                 std::holds_alternative<MissionOrder>(*message) ||
                 std::holds_alternative<PlaceOrder>(*message));
  }
}

/// Any target, host and origin are answered; a socket opens for the own page alone.
void AnswerAnyRequest(std::string_view text) {
  static const WebFiles kFiles{{"/", {"text/html", "page"}}};
  const auto first = text.find('\n'), second = text.find('\n', first + 1);
  if (second == std::string_view::npos) return;
  const std::string target(text.substr(0, first)), host(text.substr(first + 1, second - first - 1)),
      origin(text.substr(second + 1));
  const WebAnswer answer = Answer({"GET", target, host, origin, true}, kFiles, {});
  if (std::holds_alternative<OpenSocket>(answer)) bus::Require(origin.ends_with("://" + host));
}

}  // namespace
}  // namespace priamos::console

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  priamos::console::ReadAnyMessage(text);
  priamos::console::ReadAnyClientMessage(text);
  priamos::console::AnswerAnyRequest(text);
  return 0;
}
