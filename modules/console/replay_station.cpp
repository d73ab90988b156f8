#include "console/replay_station.hpp"

#include <utility>
#include <variant>

#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"
#include "console/greeting.hpp"

namespace priamos::console {

ReplayStation::ReplayStation(std::unique_ptr<ShownLog> log, const bus::Schema& schema, const GroundPlan& plan,
                             std::string greeting, const WebServerOptions& options)
    : log_(std::move(log)),
      greeting_(std::move(greeting)),
      schema_(schema),
      files_(schema),
      feed_(schema),
      bridge_(schema, {}, "",
              [this](ClientId client, std::string message, bool binary) {
                return server_.Queue(client, std::move(message), binary);
              }),
      server_(options, files_.files(), *this) {
  OfferShownChannels(bridge_);
  bridge_.OfferScene(&plan, log_->time());
}

void ReplayStation::Joined(std::uint64_t client, const OpenSocket& socket) {
  if (socket.dialect == Dialect::kFoxglove) return bridge_.Join(client, socket.role);
  audience_.Join(client, socket.role);
}

void ReplayStation::Left(std::uint64_t client) {
  if (bridge_.Has(client)) bridge_.Leave(client);
  audience_.Leave(client);
}

void ReplayStation::Tick(Time now) {
  now_ = now;
  server_.Poll(now);
  log_->Play(now, *this);
  bridge_.Tick(now, log_->time());
  if (!beat_.Due(now)) return;
  beat_.Mark(now);
  audience_.Tell(server_, greeting_, feed_.news(), beats_.Next(now), log_->time(),
                 [this](ClientId, Role) { return Station(); });
}

void ReplayStation::Heard(const std::string& channel, std::span<const std::byte> bytes, Time time) {
  const bus::Struct* type = schema_.Of(bytes);
  if (type == nullptr || !bus::Walk(*type, bytes)) return;  // damaged
  feed_.Hear(channel, bytes, time);
  bridge_.Hear(channel, bytes, time);
}

void ReplayStation::Begun() {
  feed_.Forget();
  bridge_.Forget();
  audience_.StartAgain();
}

bool ReplayStation::Said(std::uint64_t client, std::string_view text, bool binary) {
  if (bridge_.Has(client)) return !bridge_.Said(client, text, binary);
  if (binary) return false;
  const auto message = ReadBrowserMessage(text);
  if (!message) return false;
  if (const auto* order = std::get_if<ReplayOrder>(&*message)) log_->Obey(*order, now_, *this);
  // What is meant for a robot finds none here.
  return true;
}

nlohmann::ordered_json ReplayStation::Station() const {
  return {{"role", "viewer"},          {"seat", "free"}, {"session", 0},
          {"phase", "no_device"},      {"mode", "base"}, {"fast", false},
          {"pages", audience_.size()}, {"refused", 0},   {"late", 0},
          {"replay", log_->State()}};
}

}  // namespace priamos::console
