#include "bus/replay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"
#include "common/config.hpp"
#include "common/serial_port.hpp"

namespace priamos::bus {
namespace {

/// A time further ahead than this is damaged: nobody wants to tick through it.
constexpr Duration kLongestPause = std::chrono::hours(1);

/// A serial line on which nothing ever comes: the log has no bytes of it.
class SilentLine : public ByteStream {
 public:
  std::size_t Read(std::span<std::byte>) override { return 0; }
  std::size_t Write(std::span<const std::byte> bytes) override { return bytes.size(); }
};

/// The HEALTH message of a process, if the event is one.
std::optional<health_t> HealthOf(const LogEvent& event, const Schema& schema) {
  if (event.channel != channels::kHealth.name) return std::nullopt;
  const Struct* type = schema.Find(static_cast<std::uint64_t>(health_t::getHash()));
  if (type == nullptr || !Walk(*type, event.bytes)) return std::nullopt;
  return Decode<health_t>(event.bytes);
}

Time StartOf(LogReader reader, const std::string& process, const Schema& schema) {
  constexpr std::int64_t kLargest = log_format::kLargestTime;
  std::optional<Time> first;
  while (const auto event = reader.Next()) {
    if (!first) first = FromUtime(event->utime);
    const auto health = HealthOf(*event, schema);
    if (health && health->process == process &&
        std::clamp(health->utime, -kLargest, kLargest) == health->utime)
      return FromUtime(health->utime);
  }
  if (!first) throw std::runtime_error("the log holds no event");
  return *first;
}

}  // namespace

Replay::Replay(const AppFactory& factory, const ConfigSource& source, const Schema& schema,
               const std::string& log_path, const Options& options)
    : name_(factory.name.substr(0, 16)),
      schema_(schema),
      reader_(log_path),
      clock_(StartOf(LogReader(log_path), name_, schema)),
      bus_("memq://") {
  Surroundings around;
  around.instance = "replay";
  around.config_dir = options.config_dir;
  around.seed = options.seed;
  around.lockstep = true;
  around.from_log = true;
  around.log = options.log ? options.log : [](Level, std::string_view) {};
  around.open_serial = [](const std::string&, int) { return std::make_unique<SilentLine>(); };
  bus_.SubscribeEverything([this](std::string_view channel, std::span<const std::byte> bytes) {
    if (!feeding_)
      send_({ToUtime(clock_.Now()), std::string(channel), std::vector(bytes.begin(), bytes.end())});
  });
  host_ = std::make_unique<AppHost>(factory, source, bus_, schema, clock_, std::move(around));
}

Replay::~Replay() = default;

bool Replay::IsOwn(const LogEvent& event) const {
  if (event.channel == channels::kHealth.name) {
    const auto health = HealthOf(event, schema_);
    return health && health->process == name_;
  }
  const auto& outputs = host_->node().outputs();
  return std::any_of(outputs.begin(), outputs.end(),
                     [&](const Endpoint& output) { return output.channel == event.channel; });
}

void Replay::TickUntil(Time until, bool including) {
  while (!host_->exit_code() && (host_->next_tick() < until || (including && host_->next_tick() == until))) {
    clock_.Set(host_->next_tick());
    host_->Step(clock_.Now());
    bus_.Drain();
  }
  if (clock_.Now() < until) clock_.Set(until);
}

void Replay::Feed(const LogEvent& event) {
  feeding_ = true;
  bus_.Publish(event.channel, event.bytes);
  bus_.Drain();
  feeding_ = false;
  ++fed_;
}

void Replay::Run(const std::function<void(const Output&)>& send) {
  send_ = send;
  const Time start = clock_.Now();
  while (const auto event = reader_.Next()) {
    const Time at = FromUtime(event->utime);
    if (at < start) continue;
    if (host_->exit_code()) break;
    if (at - clock_.Now() > kLongestPause) {
      ++implausible_;
      continue;
    }
    const bool own = IsOwn(*event);
    TickUntil(at, own);
    if (own) {
      recorded_.push_back({event->utime, event->channel, event->bytes});
    } else {
      Feed(*event);
    }
  }
}

std::string Replay::Summary(std::uint64_t sent) const {
  std::string text = fmt::format("{} messages heard, {} sent", fed(), sent);
  if (skipped_bytes() > 0) text += fmt::format(", {} damaged bytes skipped", skipped_bytes());
  if (implausible_ > 0) text += fmt::format(", {} of an impossible time left out", implausible_);
  return text;
}

}  // namespace priamos::bus
