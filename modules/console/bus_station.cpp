#include "console/bus_station.hpp"

#include <nlohmann/json.hpp>

#include "bus/version.hpp"
#include "console/core/browser_message.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLargestShown = 1 << 16;  ///< what is larger, a picture perhaps, no page can plot

/// There is no robot to drive, and no plan.
Json StationState(std::size_t pages) {
  return {{"role", "viewer"},     {"seat", "free"}, {"session", 0},
          {"phase", "no_device"}, {"mode", "base"}, {"fast", false},
          {"pages", pages},       {"refused", 0},   {"late", 0}};
}

std::string GreetingOfABus() {
  return Json{{"type", "hello"},
              {"version", bus::Version()},
              {"any_bus", true},
              {"plan", {{"walls", Json::array()}, {"doors", Json::array()}, {"cupboards", Json::array()}}},
              {"body", {{"length_m", kDrawnBody.length_m}, {"width_m", kDrawnBody.width_m}}},
              {"link", {{"bytes_per_s", 0}}},
              {"channels", Json::object()}}
      .dump();
}

}  // namespace

BusStation::BusStation(const bus::Schema& schema, const WebServerOptions& options)
    : files_(schema),
      feed_(schema),
      bridge_(schema, kDrawnBody, "",
              [this](ClientId client, std::string message, bool binary) {
                return server_.Queue(client, std::move(message), binary);
              }),
      greeting_(GreetingOfABus()),
      server_(options, files_.files(), *this) {
  bridge_.OfferScene(nullptr, {});
}

void BusStation::Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival) {
  if (audience_.size() > 0 && bytes.size() <= kLargestShown) feed_.Hear(channel, bytes, arrival);
  bridge_.Hear(channel, bytes, arrival);
}

void BusStation::Tick(Time now) {
  server_.Poll(now);
  bridge_.Tick(now, now);
  if (!beat_.Due(now)) return;
  beat_.Mark(now);
  audience_.Tell(server_, greeting_, feed_.news(), beats_.Next(now), now,
                 [this](ClientId, Role) { return StationState(audience_.size() + bridge_.clients()); });
}

void BusStation::Joined(std::uint64_t client, const OpenSocket& socket) {
  if (socket.dialect == Dialect::kFoxglove) return bridge_.Join(client, socket.role);
  audience_.Join(client, socket.role);
}

bool BusStation::Said(std::uint64_t client, std::string_view message, bool binary) {
  if (bridge_.Has(client)) return !bridge_.Said(client, message, binary);
  return !binary && ReadBrowserMessage(message);  // what is meant for a robot finds none here
}

void BusStation::Left(std::uint64_t client) {
  if (bridge_.Has(client)) bridge_.Leave(client);
  audience_.Leave(client);
}

}  // namespace priamos::console
