#include "console/replay_station.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"
#include "console/greeting.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

/// After a seek this part of the log before it is played at once: states are known by then.
constexpr Duration kBefore = std::chrono::seconds(15);
/// Most events between two looks at the pages.
constexpr int kAtMost = 2000;

}  // namespace

ReplayStation::ReplayStation(bus::LogPlayer log, const bus::Schema& schema, const GroundPlan& plan,
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
  bridge_.OfferScene(&plan, log_.begin());
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
  Play(kAtMost);
  bridge_.Tick(now, LogTime());
  if (!beat_.Due(now)) return;
  beat_.Mark(now);
  audience_.Tell(server_, greeting_, feed_.news(), beats_.Next(now), LogTime(),
                 [this](ClientId, Role) { return Station(); });
}

void ReplayStation::Play(int at_most) {
  const auto hear = [this](const std::string& channel, const bus::LogEvent& event) {
    const bus::Struct* type = schema_.Find(bus::FingerprintOf(event.bytes.data(), event.bytes.size()));
    if (type == nullptr || !bus::Walk(*type, event.bytes)) return;  // damaged
    feed_.Hear(channel, event.bytes, FromUtime(event.utime));
    bridge_.Hear(channel, event.bytes, FromUtime(event.utime));
  };
  log_.Play(now_, hear, at_most);
}

bool ReplayStation::Said(std::uint64_t client, std::string_view text, bool binary) {
  if (bridge_.Has(client)) return !bridge_.Said(client, text, binary);
  if (binary) return false;
  const auto message = ReadBrowserMessage(text);
  if (!message) return false;
  if (const auto* order = std::get_if<ReplayOrder>(&*message)) Obey(*order);
  // What is meant for a robot finds none here.
  return true;
}

void ReplayStation::Obey(const ReplayOrder& order) {
  using enum ReplayOrder::Kind;
  switch (order.kind) {
    case kPlay:
      if (log_.position() >= log_.length()) Seek({});
      return log_.Pause(false, now_);
    case kPause:
      return log_.Pause(true, now_);
    case kStep:
      return log_.Step(now_);
    case kSeek:
      return Seek(FromSeconds(order.value));
    case kSpeed:
      return log_.SetSpeed(order.value, now_);
  }
}

void ReplayStation::Seek(Duration position) {
  const bool paused = log_.paused();
  const double speed = log_.speed();
  feed_.Forget();
  audience_.StartAgain();
  log_.Seek(std::max(position - kBefore, Duration::zero()), now_);
  log_.Pause(false, now_);
  log_.SetSpeed(bus::LogPlayer::kFlatOut, now_);
  while (!log_.done() && log_.position() < std::min(position, log_.length())) Play(1);
  log_.SetSpeed(speed, now_);
  log_.Pause(paused, now_);
}

Time ReplayStation::LogTime() const {
  return log_.begin() + log_.position();
}

Json ReplayStation::Station() const {
  return {{"role", "viewer"},
          {"seat", "free"},
          {"session", 0},
          {"phase", "no_device"},
          {"mode", "base"},
          {"fast", false},
          {"pages", audience_.size()},
          {"refused", 0},
          {"late", 0},
          {"replay",
           {{"position_s", Seconds(log_.position())},
            {"speed", log_.speed()},
            {"paused", log_.paused() || log_.done()}}}};
}

}  // namespace priamos::console
