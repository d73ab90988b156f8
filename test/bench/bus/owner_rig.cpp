#include "test/bench/bus/owner_rig.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "bus/wire/bus_address.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

constexpr int kSession = 7;
constexpr Duration kCommandPeriod{40'000}, kLeasePeriod{300'000};
constexpr double kTurn_rad_s = 0.6, kDrives_rad_s = 0.4, kStands_rad_s = 0.02;
/// Two command when each did within this time: the bound that the wheels have to hold.
constexpr Duration kTogether{100'000};
constexpr Duration kStateIsFresh{100'000};

std::string FieldWorld(const OwnerRigOptions& options) {
  const std::string file = options.run_folder + "/field.toml",
                    folder = options.source_folder + "/test/bench/field";
  std::ofstream(file) << "map = \"" << folder << "/map.toml\"\n"
                      << std::ifstream(folder + "/world.toml").rdbuf();
  return file;
}

std::string OnboardUrl() {
  return bus::BusUrl(bus::kDefaultRobot, bus::BusSide::kOnboard, 1);
}

}  // namespace

/// What is seen and said on the bus of one computer.
struct OwnerRig::Side {
  Side(const bus::Schema& schema, const bus::Clock& clock)
      : bus(OnboardUrl()),
        node(bus, schema, clock),
        commands(node.SubscribeAll(channels::kWheelCommand)),
        states(node.SubscribeAll(channels::kWheelState)),
        truth(node.Subscribe(channels::kWorldTruth)),
        claims(node.SubscribeAll(channels::kClaim)),
        alarms(node.SubscribeAll(channels::kAlarm)),
        drive(node.Advertise(channels::kDriveCommand)),
        lease(node.Advertise(channels::kLeaseRequest)) {}

  /// The hand is on the stick; now and then it rests for one command, as a robot that has just begun demands.
  void Operate(Time now) {
    if (now - leased >= kLeasePeriod) {
      leased = now;
      lease_request_t request{};
      request.utime = ToUtime(now);
      request.driver = lease_request_t::TELEOP;
      request.session = kSession;
      request.action = lease_request_t::ACQUIRE;
      lease.Publish(request);
    }
    if (now - wished < kCommandPeriod) return;
    wished = now;
    drive_command_t wish{};
    wish.utime = ToUtime(now);
    wish.driver = lease_request_t::TELEOP;
    wish.session = kSession;
    wish.sequence = ++sequence & 0xffff;
    wish.time_to_live_s = 0.2;
    wish.wz_rad_s = sequence % 10 == 0 ? 0 : kTurn_rad_s;
    drive.Publish(wish);
  }

  bus::LcmBus bus;
  bus::Node node;
  bus::Inbox<wheel_command_t> commands;
  bus::Inbox<wheel_state_t> states;
  bus::Latest<world_truth_t> truth;
  bus::Inbox<claim_t> claims;
  bus::Inbox<alarm_t> alarms;
  bus::Publisher<drive_command_t> drive;
  bus::Publisher<lease_request_t> lease;
  std::map<int, claim_t> claim_of;         ///< newest by process
  std::map<std::int32_t, Time> commanded;  ///< last by instance
  Time leased{}, wished{};
  int sequence = 0;
};

OwnerRig::OwnerRig(const OwnerRigOptions& options) : options_(options), schema_(bus::OwnTypes()) {
  for (const auto side : {TwoNetworks::Side::kLeft, TwoNetworks::Side::kRight})
    networks.In(side, [&] { sides_.push_back(std::make_shared<Side>(schema_, clock_)); });
  world_ = std::make_unique<Program>(
      networks, TwoNetworks::Side::kLeft,
      std::vector<std::string>{options.program_folder + "/priamos-world", "--config",
                               options.source_folder + "/config/sim/world.toml", "--world",
                               FieldWorld(options), "--bus", OnboardUrl(), "--seed",
                               std::to_string(options.seed)},
      options.run_folder + "/world.txt");
  if (!Until([this] { return state_at_ != Time{}; }, std::chrono::seconds(30)))
    throw std::runtime_error("the world did not start: " + world_->Console());
}

std::unique_ptr<Program> OwnerRig::StartRobot(TwoNetworks::Side side) {
  return std::make_unique<Program>(
      networks, side,
      std::vector<std::string>{options_.program_folder + "/priamos-robot", "--config",
                               options_.source_folder + "/config/sim/robot.toml", "--bus", OnboardUrl()},
      fmt::format("{}/robot-{}.txt", options_.run_folder, ++programs_));
}

OwnerRig::Side& OwnerRig::Of(TwoNetworks::Side side) const {
  return *sides_[side == TwoNetworks::Side::kLeft ? 0 : 1];
}

bool OwnerRig::Until(const std::function<bool()>& done, Duration most) {
  for (const Time end = Now() + most; Now() < end; usleep(1000)) {
    Step();
    if (done()) return true;
  }
  return false;
}

void OwnerRig::Wait(Duration duration) {
  Until([] { return false; }, duration);
}

void OwnerRig::Step() {
  for (const auto& side : sides_) {
    side->bus.Drain();
    side->Operate(Now());
    for (const claim_t& claim : side->claims.Drain()) side->claim_of[claim.pid] = claim;
  }
  Side& right = Of(TwoNetworks::Side::kRight);
  for (const auto& [arrival, command] : right.commands.DrainWithArrival())
    right.commanded[command.instance] = arrival;
  Watch();
}

void OwnerRig::Watch() {
  Side& left = Of(TwoNetworks::Side::kLeft);
  watch.alarms += static_cast<int>(left.alarms.Drain().size());
  if (const auto truth = left.truth.Take()) {
    turn_before_rad_s_ = turn_rad_s_;
    turn_rad_s_ = truth->wz_rad_s;
    const auto from = expected_ ? expected_ : watch.second;
    if (from && !watch.stood && std::abs(turn_rad_s_) < kStands_rad_s) watch.stood = Now() - *from;
  }
  WatchCommands();
  for (const wheel_state_t& state : left.states.Drain()) WatchState(state);
}

void OwnerRig::WatchCommands() {
  Side& left = Of(TwoNetworks::Side::kLeft);
  for (const auto& [arrival, command] : left.commands.DrainWithArrival()) {
    left.commanded[command.instance] = arrival;
    if (watch.instances.insert(command.instance).second && watch.instances.size() == 2)
      watch.second = arrival;
  }
}

/// Two are obeyed while both command and the wheels are neither said to be held nor seen to slow down.
void OwnerRig::WatchState(const wheel_state_t& state) {
  const Time now = Now();
  state_ = state;
  state_at_ = now;
  watch.contested = watch.contested || state.contested;
  int together = 0;
  for (const auto& [instance, last] : Of(TwoNetworks::Side::kLeft).commanded)
    together += now - last < kTogether;
  const bool held = state.contested || state.deadline_stopped ||
                    std::abs(turn_rad_s_) < std::abs(turn_before_rad_s_) ||
                    std::abs(turn_rad_s_) < kStands_rad_s;
  if (together < 2 || held) return two_since_.reset();
  if (!two_since_) two_since_ = now;
  watch.two_obeyed = std::max(watch.two_obeyed, now - *two_since_);
}

std::optional<std::int32_t> OwnerRig::Obeyed() const {
  if (Now() - state_at_ > kStateIsFresh || state_.contested || state_.deadline_stopped) return std::nullopt;
  return state_.instance;
}

bool OwnerRig::Holds(TwoNetworks::Side side, const Program& robot) const {
  const auto& claims = Of(side).claim_of;
  const auto found = claims.find(robot.pid());
  return found != claims.end() && found->second.state == claim_t::HOLDS;
}

bool OwnerRig::Commands(TwoNetworks::Side side, const Program& robot) const {
  const auto claim = Of(side).claim_of.find(robot.pid());
  return claim != Of(side).claim_of.end() && Of(side).commanded.contains(claim->second.instance);
}

bool OwnerRig::Drives(const Program& robot) const {
  for (const auto& side : sides_) {
    const auto claim = side->claim_of.find(robot.pid());
    if (claim != side->claim_of.end() && Obeyed() == claim->second.instance)
      return turn_rad_s_ > kDrives_rad_s;
  }
  return false;
}

void OwnerRig::Forget() {
  watch = {};
  for (const auto& side : sides_) side->commanded.clear();
  two_since_.reset();
  expected_.reset();
}

void OwnerRig::Mark() {
  expected_ = Now();
  watch.stood.reset();
}

}  // namespace priamos::bench
