#include "bus/probe_answerer.hpp"

#include <stdexcept>
#include <utility>

#include "bus/node.hpp"
#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/multicast.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kHostBytes = 64, kProcessBytes = 16, kNetworkBytes = 16;  // @max of probe_t

}  // namespace

probe_t MakeProbe(const HostIdentity& host, const std::string& process, const std::string& url, Time now) {
  probe_t message{};
  message.utime = ToUtime(now);
  const BusDeparture from = DepartureOf(url);
  message.host_id = host.IdAt(from.address);
  message.host = host.name.substr(0, kHostBytes);
  message.process = process.substr(0, kProcessBytes);
  message.network = from.interface.substr(0, kNetworkBytes);
  message.ttl = static_cast<std::int16_t>(TtlOf(url));
  return message;
}

ProbeAnswerer::ProbeAnswerer(LcmBus& bus, const Schema& schema, const Clock& clock, std::string process)
    : bus_(bus), schema_(schema), clock_(clock), process_(std::move(process)), host_(ThisHost()) {
  bus.Subscribe(channels::kProbe.name,
                [this](std::string_view, std::span<const std::byte> bytes) { OnMessage(bytes); });
}

bool ProbeAnswerer::MayAnswer(Time now) {
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    in_second_ = 0;
  }
  return ++in_second_ <= kMostAnswers;
}

/// Handlers must not throw.
void ProbeAnswerer::OnMessage(std::span<const std::byte> bytes) {
  try {
    const auto question = DecodeChecked<probe_t>(schema_, bytes);
    const Time now = clock_.Now();
    if (!question || question->kind != probe_t::ASKS || !MayAnswer(now)) return;
    probe_t answer = MakeProbe(host_, process_, bus_.url(), now);
    answer.kind = probe_t::ANSWERS;
    answer.instance = question->instance;
    answer.number = question->number;
    bus_.Publish(channels::kProbe.name, Encode(answer));
    answer.alone = 1;
    bus_.Answer(channels::kProbe.name, Encode(answer));
    ++answers_;
  } catch (const std::exception&) {
    // Not a question: a foreign or damaged message, which a process on the bus has to live with.
  }
}

}  // namespace priamos::bus
