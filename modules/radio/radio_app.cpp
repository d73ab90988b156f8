#include "radio/radio_app.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string_view>

#include "bus/radio/budget.hpp"
#include "bus/radio/shared_budget.hpp"
#include "bus/type_files.hpp"
#include "common/config.hpp"
#include "common/input/quoted.hpp"
#include "common/random.hpp"
#include "radio/key_file.hpp"
#include "radio/kiss_port.hpp"
#include "radio/private_line.hpp"
#include "radio/state_files.hpp"

namespace priamos::radio {
namespace {

using bus::radio::Direction;

constexpr Duration kReportPeriod{1'000'000};
/// Bytes that may wait for a port that takes none; more are dropped, because late bytes are worth nothing.
constexpr std::size_t kMostUnwritten = 64;

std::optional<bus::Schema> TypesIn(const std::string& folder) {
  if (folder.empty()) return std::nullopt;
  return bus::Schema(bus::ReadTypeFiles(folder));
}

}  // namespace

RadioApp::RadioApp(const RadioConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      link_config_(LoadLink()),
      own_types_(TypesIn(config.types)),
      outgoing_(config.side == "onboard" ? Direction::kUp : Direction::kDown) {
  context.SetHealthName(config.side + "-radio");  // the workstation hears both ends
  CheckRobots();
  if (IsNetPort(config.port)) (void)ParseNetAddress(config.port, config.place.Of("port"));
  bus::radio::RequireBudget(link_config_.Table(types()), link_config_.Options());
  if (link_config_.robots > 0 && outgoing_ == Direction::kDown) {
    AddRobots();
  } else {
    AddEnd({.name = "",
            .key_file = link_config_.key_file,
            .state_file = config.state_file,
            .fast_state_file = config.fast_state_file,
            .place = config.place},
           static_cast<std::uint8_t>(config.address), context.node());
  }
  OpenLine();
  if (link_config_.simulation_key && !context.lockstep())
    context.Log(bus::Level::kInfo,
                "the link has the simulation key, which everybody knows; no key file is read");
}

RadioApp::~RadioApp() {
  for (const auto& end : ends_) {
    try {
      end->Close();
    } catch (const std::exception& error) {
      context_.Log(bus::Level::kError, error.what());
    }
  }
}

/// Both files say how many robots there are; each says it for its reader.
void RadioApp::CheckRobots() const {
  const std::string file = context_.ResolvePath(config_.link), address = config_.place.Of("address");
  const int robots = link_config_.robots;
  if (outgoing_ == Direction::kUp && (config_.address == 0) != (robots == 0))
    throw ConfigError(fmt::format("{}: expected {} with robots = {} in {}, got {}", address,
                                  robots == 0 ? "0" : fmt::format("1 to {}", robots), robots, file,
                                  config_.address));
  if (config_.address > robots)
    throw ConfigError(fmt::format("{}: expected at most {}, the robots of {}, got {}", address, robots, file,
                                  config_.address));
  if (outgoing_ == Direction::kDown && static_cast<int>(config_.robots.size()) != robots)
    throw ConfigError(fmt::format("{}: expected {} [[robot]] tables, the robots of {}, got {}",
                                  config_.place.Of("robot"), robots, file, config_.robots.size()));
}

/// Two links in one memory would take each other's events for their own.
void RadioApp::CheckFiles() const {
  std::map<std::string, std::string> used;
  for (std::size_t i = 0; i < config_.robots.size(); ++i) {
    const StationRobot& robot = config_.robots[i];
    if (!link_config_.simulation_key && robot.key_file.empty())
      throw ConfigError(fmt::format("{}: expected the key of {}, got none", robot.place.Of("key_file"),
                                    Quoted(robot.name)));
    const auto add = [&](const char* key, const std::string& file) {
      if (file.empty()) return;
      std::error_code unknown;  // refused when it is read
      const std::string path =
          std::filesystem::weakly_canonical(context_.ResolvePath(file), unknown).string();
      if (unknown) return;
      const std::string place = fmt::format("robot[{}].{}", i, key);
      const auto [at, is_new] = used.emplace(path, place);
      if (!is_new)
        throw ConfigError(fmt::format("{}: expected a file of its own, got that of {}, {}",
                                      robot.place.Of(key), at->second, Quoted(file)));
    };
    if (!link_config_.simulation_key) add("key_file", robot.key_file);
    add("state_file", robot.state_file);
    add("fast_state_file", robot.fast_state_file);
  }
}

void RadioApp::AddRobots() {
  CheckFiles();
  for (std::size_t i = 0; i < config_.robots.size(); ++i) {
    const StationRobot& robot = config_.robots[i];
    for (std::size_t k = 0; k < i; ++k)
      if (config_.robots[k].name == robot.name)
        throw ConfigError(fmt::format("{}: expected different names, got {} twice", robot.place.Of("name"),
                                      Quoted(robot.name)));
    buses_.push_back(context_.OpenBus(robot.name));
    AddEnd(robot, static_cast<std::uint8_t>(i + 1), buses_.back()->node());
  }
}

void RadioApp::AddEnd(const StationRobot& robot, std::uint8_t address, bus::Node& node) {
  const std::string key_file = link_config_.simulation_key ? "" : context_.ResolvePath(robot.key_file);
  const bus::radio::LinkKey key = LoadKey(key_file);
  // A key that two robots share lets each read and make the frames of the other.
  if (!link_config_.simulation_key && std::find(keys_.begin(), keys_.end(), key) != keys_.end())
    throw ConfigError(fmt::format(
        "{}: expected a key of its own for robot {} in {}, got that of another robot: make one with "
        "`priamos link keygen`",
        robot.place.Of("key_file"), Quoted(robot.name), key_file));
  keys_.push_back(key);
  const auto next_key = key_file.empty() ? std::nullopt : LoadNextKey(key_file, key);
  ends_.push_back(std::make_unique<BusEnd>(
      BusEndParts{.link = link_config_,
                  .types = types(),
                  .outgoing = outgoing_,
                  .address = address,
                  .name = robot.name,
                  .key = key,
                  .next_key = next_key,
                  .key_file = key_file,
                  .store = OpenStore(robot, address),
                  .nonces = Nonces(),
                  .tick = TickPeriod()},
      node, [this](bus::Level level, std::string_view text) { context_.Log(level, text); }));
}

std::unique_ptr<bus::radio::StateStore> RadioApp::OpenStore(const StationRobot& robot, std::uint8_t address) {
  if (robot.state_file.empty()) return std::make_unique<bus::radio::MemoryStore>();
  auto store = OpenStateFiles(
      {.file = context_.ResolvePath(robot.state_file),
       .fast_file = robot.fast_state_file.empty() ? "" : context_.ResolvePath(robot.fast_state_file),
       .key_file = link_config_.simulation_key ? "" : context_.ResolvePath(robot.key_file),
       .place = robot.place,
       .end = fmt::format("{}:{}", config_.side, address)});
  stores_.push_back(store.get());
  return store;
}

bus::radio::LinkConfig RadioApp::LoadLink() const {
  bus::radio::LinkConfig link = config_.HasOwnLink()
                                    ? config_.own_link
                                    : LoadConfig<bus::radio::LinkConfig>(context_.ResolvePath(config_.link));
  // Who owns what and what time it is are settled on each bus, and each radio reports its own end.
  for (const auto& channel : link.channels)
    for (const std::string_view of_one_bus :
         {channels::kClaim.name, channels::kProbe.name, channels::kClock.name, channels::kWheelCommand.name,
          channels::kLinkStatus.name, channels::kLinkRequest.name})
      if (channel.name == of_one_bus)
        throw ConfigError(fmt::format("{}: expected a channel that may cross the radio, got {}",
                                      channel.place.Of("name"), channel.name));
  return link;
}

void RadioApp::OpenLine() {
  if (IsKissPort(config_.port)) {
    if (link_config_.medium != "packet")
      throw ConfigError(fmt::format("{}: expected \"packet\" with port {}, got \"{}\"",
                                    link_config_.place.Of("medium"), Quoted(config_.port),
                                    link_config_.medium));
    net_ = OpenKissPort(context_.OpenSerial(TtyOf(config_.port), link_config_.baud));
    return;
  }
  if (!IsNetPort(config_.port)) {
    port_ = context_.OpenSerial(config_.port, link_config_.baud);
    return;
  }
  NetAddress address = ParseNetAddress(config_.port, config_.place.Of("port"));
  address.loopback_only = link_config_.simulation_key;
  if (address.datagrams != link_config_.Options().datagrams)
    throw ConfigError(fmt::format("{}: expected {} with port {}, got {}", link_config_.place.Of("datagrams"),
                                  address.datagrams, Quoted(config_.port), link_config_.Options().datagrams));
  net_ = OpenNetPort(address);
}

bus::radio::LinkKey RadioApp::LoadKey(const std::string& file) const {
  if (!link_config_.simulation_key) return ReadKeyFile(file);
  if (context_.lockstep()) return SimulationKey();
  const std::string tty = IsKissPort(config_.port) ? TtyOf(config_.port) : config_.port;
  std::error_code unknown;  // a loop of links: see OpenLine, as for one that is not there
  const bool is_there = IsNetPort(config_.port) || std::filesystem::exists(tty, unknown);
  if (is_there && !IsPrivateLine(config_.port))
    throw ConfigError(fmt::format(
        "{}: expected false on {}, which others can reach, got true: make a key with `priamos link "
        "keygen`",
        link_config_.place.Of("simulation_key"), Quoted(config_.port)));
  return SimulationKey();
}

/// A next key that cannot be used, as a copy that was cut off, must not take the link away.
std::optional<bus::radio::LinkKey> RadioApp::LoadNextKey(const std::string& file,
                                                         const bus::radio::LinkKey& key) const {
  try {
    return ReadNextKeyFile(file, key);
  } catch (const std::runtime_error& error) {
    context_.Log(bus::Level::kError, fmt::format("{}; the link goes on under its key", error.what()));
    return std::nullopt;
  }
}

bus::radio::NonceSource RadioApp::Nonces() const {
  const auto timed = [&clock = context_.node()](std::uint64_t random) {
    return bus::radio::TimedNonce(random, clock.Now());
  };
  if (context_.lockstep())
    return [timed, rng = Rng::Stream(context_.seed(), "radio " + config_.side)]() mutable {
      return timed(rng.engine()());
    };
  return [timed] {
    std::uint64_t random = 0;
    randombytes_buf(&random, sizeof random);
    return timed(random);
  };
}

void RadioApp::Start(Time now) {
  std::vector<bus::radio::LinkEndpoint*> links;
  for (const auto& end : ends_) {
    end->Start(now);
    links.push_back(&end->link());
  }
  if (!buses_.empty())
    station_.emplace(bus::radio::SharedChannelOf(link_config_.Table(types()), link_config_.Options()),
                     std::move(links));
  next_report_ = now + kReportPeriod;
}

void RadioApp::Tick(Time now) {
  for (const auto& bus : buses_) bus->Drain();
  if (!next_report_) Start(now);
  for (const auto& end : ends_) end->Tick(now);
  ReadLine();
  // Not the time of before the reading: a byte that is late by what the reading took is in another's turn.
  FeedLine(context_.node().Now());
  if (now >= *next_report_) Report(now);
}

void RadioApp::ReadLine() {
  if (net_) return ReadFrames();
  std::array<std::byte, 256> buffer;
  for (;;) {
    const Time before = context_.node().Now();
    const std::size_t n = port_->Read(buffer);
    if (n > 0) Receive(std::span(buffer).first(n));
    station_ ? station_->OnLook(before) : ends_[0]->link().OnLook(before);
    if (n == 0) return;
  }
}

void RadioApp::Receive(std::span<const std::byte> bytes) {
  // Taken after the reading: bytes must never seem to have arrived before they did.
  const Time now = context_.node().Now();
  if (station_)
    return station_->Receive(bytes, now, [&](std::size_t robot, const bus::radio::Delivery& delivery) {
      ends_[robot]->Publish(delivery, now);
    });
  for (const bus::radio::Delivery& d : ends_[0]->link().Receive(bytes, now)) ends_[0]->Publish(d, now);
}

void RadioApp::ReadFrames() {
  for (const NetFrame& frame : net_->Read([this] { return context_.node().Now(); })) {
    const auto received =
        ends_[0]->link().ReceiveFrame(frame.bytes, frame.first_byte, frame.arrived, frame.stranger);
    if (received.proof != bus::radio::Proof::kNone) net_->Judge(frame, received.proof);
    for (const bus::radio::Delivery& d : received.deliveries) ends_[0]->Publish(d, frame.arrived);
  }
}

void RadioApp::FeedLine(Time now) {
  const auto bytes = station_ ? station_->Step(now) : ends_[0]->link().Step(now);
  unwritten_.insert(unwritten_.end(), bytes.begin(), bytes.end());
  if (unwritten_.empty()) return;
  const std::size_t n = net_ ? net_->Write(unwritten_, now) : port_->Write(unwritten_);
  unwritten_.erase(unwritten_.begin(), unwritten_.begin() + static_cast<std::ptrdiff_t>(n));
  if (unwritten_.size() > kMostUnwritten) unwritten_.clear();
}

/// Of several robots' links the worst one is the health of the process.
void RadioApp::Report(Time now) {
  next_report_ = now + kReportPeriod;
  LinkHealth worst;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const link_status_t message = ends_[i]->Report(net_ ? net_->turned_away() : 0, now);
    const bus::radio::LinkEndpoint& link = ends_[i]->link();
    LinkHealth health = HealthOf(message, link.table().code_bytes(), link.Status(now).peer_code_bytes);
    if (!health.why.empty() && station_) health.why = config_.robots[i].name + ": " + health.why;
    if (health.health > worst.health) worst = health;
  }
  const LinkHealth memory = ReportMemory(now);
  if (memory.health >= worst.health && !memory.why.empty()) worst = memory;
  context_.SetHealth(worst.health, worst.why);
}

/// The link goes on without a memory, an emergency stop above all; a person has to know.
LinkHealth RadioApp::ReportMemory(Time now) {
  std::string problem;
  for (FileStore* store : stores_) {
    store->Retry();
    if (problem.empty()) problem = store->problem();
  }
  const bool is_new = !problem.empty() && memory_problem_.empty();
  const bool is_over = problem.empty() && !memory_problem_.empty();
  memory_problem_ = problem;
  if (is_over) context_.Log(bus::Level::kInfo, "the link's memory is kept again");
  if (problem.empty()) return {};
  const std::string why = "cannot keep its memory: " + problem;
  if (is_new) RaiseAlarm(why + "; the link goes on; after a restart events may be doubled or lost", now);
  return {bus::Health::kDegraded, why};
}

void RadioApp::RaiseAlarm(const std::string& text, Time now) {
  constexpr std::size_t kTextBytes = 200;  // @max of alarm_t.text
  if (!alarms_) alarms_ = context_.node().Advertise(channels::kAlarm);
  alarm_t alarm{};
  alarm.utime = ToUtime(now);
  alarm.severity = alarm_t::WARNING;
  alarm.robot = context_.robot();
  alarm.source = std::string(kName);
  alarm.text = text.substr(0, kTextBytes);
  alarms_->Publish(alarm);
  context_.Log(bus::Level::kError, "ALARM: " + text);
}

}  // namespace priamos::radio
