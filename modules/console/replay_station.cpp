#include "console/replay_station.hpp"

#include <utility>
#include <variant>

#include "console/page_files.hpp"

namespace priamos::console {

ReplayStation::ReplayStation(std::unique_ptr<ShownLog> log, const bus::Schema& schema, std::string greeting,
                             const WebServerOptions& options)
    : log_(std::move(log)),
      greeting_(std::move(greeting)),
      feed_(schema),
      server_(options, PageFiles(), *this) {}

void ReplayStation::Tick(Time now) {
  now_ = now;
  server_.Poll(now);
  log_->Play(now, *this);
  if (!beat_.Due(now)) return;
  beat_.Mark(now);
  audience_.Tell(server_, greeting_, feed_.news(), beats_.Next(now), log_->time(),
                 [this](ClientId, Role) { return Station(); });
}

void ReplayStation::Heard(const std::string& channel, std::span<const std::byte> bytes, Time time) {
  feed_.Hear(channel, bytes, time);
}

void ReplayStation::Begun() {
  feed_.Forget();
  audience_.StartAgain();
}

bool ReplayStation::Said(std::uint64_t, std::string_view text) {
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
