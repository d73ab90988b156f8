#include "bus/lockstep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "common/config.hpp"
#include "common/serial_port.hpp"

namespace priamos::bus {

struct Lockstep::Host {
  Host(const std::string& host_name, const Schema& schema, const Clock& clock)
      : name(host_name), bus("memq://"), driver(bus, schema, clock) {}
  std::string name;
  LcmBus bus;
  Node driver;
};

/// Both directions of one serial line.
struct Lockstep::Wire {
  std::string end_a, end_b;
  radio::LinePair lines;
};

/// One end of a wire, as the App that opened it sees it.
class Lockstep::SerialEnd : public ByteStream {
 public:
  SerialEnd(std::shared_ptr<Wire> wire, radio::Line& out, radio::Line& in, const Clock& clock)
      : wire_(std::move(wire)), out_(out), in_(in), clock_(clock) {}

  std::size_t Read(std::span<std::byte> into) override {
    const auto arrived = in_.Read(clock_.Now());
    waiting_.insert(waiting_.end(), arrived.begin(), arrived.end());
    const std::size_t n = std::min(into.size(), waiting_.size());
    std::copy_n(waiting_.begin(), n, into.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }
  std::size_t Write(std::span<const std::byte> bytes) override {
    out_.Write(bytes, clock_.Now());
    return bytes.size();
  }

 private:
  std::shared_ptr<Wire> wire_;
  radio::Line& out_;
  radio::Line& in_;
  const Clock& clock_;
  std::vector<std::byte> waiting_;
};

Lockstep::Lockstep(const Schema& schema, Options options)
    : schema_(schema), options_(std::move(options)), clock_(options_.start) {}

Lockstep::~Lockstep() = default;

void Lockstep::AddBus(const std::string& name) {
  auto host = std::make_unique<Host>(name, schema_, clock_);
  host->bus.SubscribeEverything([this, name](std::string_view channel, std::span<const std::byte> bytes) {
    if (tap_) tap_(name, clock_.Now(), channel, bytes);
  });
  hosts_.push_back(std::move(host));
}

void Lockstep::AddSerialLine(const std::string& end_a, const std::string& end_b,
                             const radio::LineConfig& config) {
  const auto rng = [&](const std::string& from) { return Rng::Stream(options_.seed, "line from " + from); };
  wires_.push_back(std::make_shared<Wire>(
      Wire{end_a, end_b, radio::LinePair(config, rng(end_a), rng(end_b), clock_.Now())}));
}

Lockstep::Host& Lockstep::HostOf(const std::string& bus) {
  for (const auto& host : hosts_)
    if (host->name == bus) return *host;
  throw std::invalid_argument("lockstep: no bus named " + bus);
}

Node& Lockstep::DriverNode(const std::string& bus) {
  return HostOf(bus).driver;
}

std::unique_ptr<ByteStream> Lockstep::OpenSerial(const std::string& name) {
  for (const auto& wire : wires_) {
    radio::LinePair& lines = wire->lines;
    if (wire->end_a == name) return std::make_unique<SerialEnd>(wire, lines.a_to_b, lines.b_to_a, clock_);
    if (wire->end_b == name) return std::make_unique<SerialEnd>(wire, lines.b_to_a, lines.a_to_b, clock_);
  }
  throw std::runtime_error(
      fmt::format("{}: expected the end of a serial line of this lockstep, got no such name", name));
}

Surroundings Lockstep::SurroundingsOf(const AppFactory& factory, const Host& host,
                                      const ConfigSource& source) {
  Surroundings around;
  // Unique on this machine, so that runs side by side do not share a frame store.
  around.instance = fmt::format("lockstep-{}-{}-{}", getpid(), static_cast<const void*>(this), host.name);
  around.config_dir = source.Folder();
  around.seed = options_.seed;
  around.lockstep = true;
  around.log = [this, name = factory.name](Level level, std::string_view text) {
    if (options_.log) options_.log(clock_.Now(), name, level, text);
  };
  around.open_serial = [this](const std::string& path, int) { return OpenSerial(path); };
  return around;
}

void Lockstep::AddApp(const AppFactory& factory, const std::string& bus, const ConfigSource& source,
                      Duration phase) {
  Host& host = HostOf(bus);
  auto app = std::make_unique<AppHost>(factory, source, host.bus, schema_, clock_,
                                       SurroundingsOf(factory, host, source));
  app->TickNextAt(clock_.Now() + phase);
  members_.push_back({std::move(app), &host});
}

void Lockstep::RemoveApp(const std::string& name, const std::string& bus) {
  const auto dead = [&](const Member& m) { return m.app->name() == name && m.host->name == bus; };
  // It ticks no more, but its bus has no end of a subscription.
  for (Member& m : members_)
    if (dead(m)) buried_.push_back(std::move(m.app));
  std::erase_if(members_, [](const Member& m) { return !m.app; });
}

Time Lockstep::NextTick() const {
  Time next = Time::max();
  for (const auto& m : members_) next = std::min(next, m.app->next_tick());
  return next;
}

void Lockstep::StepAll() {
  for (const auto& m : members_) {
    if (m.app->next_tick() > clock_.Now()) continue;
    m.app->Step(clock_.Now());
    m.host->bus.Drain();
  }
}

int Lockstep::exit_code() const {
  for (const auto& m : members_)
    if (m.app->exit_code()) return *m.app->exit_code();
  return 0;
}

bool Lockstep::RunUntil(Time until, const std::function<bool()>& done) {
  for (;;) {
    const Time next = NextTick();
    if (next > until) break;
    clock_.Set(next);
    for (const auto& host : hosts_) host->bus.Drain();
    StepAll();
    if (done && done()) return true;
    if (std::any_of(members_.begin(), members_.end(),
                    [](const Member& m) { return m.app->exit_code().has_value(); }))
      return true;
  }
  clock_.Set(until);
  return false;
}

}  // namespace priamos::bus
