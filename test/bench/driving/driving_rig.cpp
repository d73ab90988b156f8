#include "test/bench/driving/driving_rig.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "common/config.hpp"
#include "test/support/radio/saturated_link.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

constexpr int kFullScale = 350;
constexpr Duration kStartWithin = std::chrono::seconds(20);
constexpr double kPlateau = 0.95;
constexpr double kMiddle_x = 2.0;

/// A map is looked for below the configuration; the field's is not there.
std::string FieldWorld(const RigOptions& options) {
  const std::string file = options.run_folder + "/field.toml",
                    folder = options.source_folder + "/test/bench/field";
  std::ofstream(file) << "map = \"" << folder << "/map.toml\"\n"
                      << std::ifstream(folder + "/world.toml").rdbuf();
  return file;
}

cli::Deployment DeploymentFor(const RigOptions& options) {
  auto deployment = LoadConfig<cli::Deployment>(options.source_folder + "/config/sim/deployment.toml");
  deployment.emulated_line = !options.own_line;
  std::erase_if(deployment.processes, [&](const cli::ScenarioProcess& p) {
    return std::find(options.modules.begin(), options.modules.end(), p.module) == options.modules.end();
  });
  for (cli::ScenarioProcess& p : deployment.processes) {
    if (p.module == "world") p.set = "world=" + FieldWorld(options);
    if (p.module == "teleop") p.after += ", spacenavd";
  }
  cli::ScenarioProcess daemon;
  daemon.module = "spacenavd";
  daemon.bus = "offboard";
  deployment.processes.push_back(daemon);
  return deployment;
}

template <class T>
void Append(bus::Inbox<T>& inbox, Time now, std::vector<Seen<T>>& all) {
  for (T& message : inbox.Drain()) all.push_back({now, std::move(message)});
}

template <class T>
void Replace(bus::Latest<T>& latest, Time now, Seen<T>& newest) {
  if (auto message = latest.Take()) newest = {now, std::move(*message)};
}

}  // namespace

DrivingRig::DrivingRig(const RigOptions& options)
    : rng(options.seed),
      options_(options),
      schema_(bus::OwnTypes()),
      deployment_(DeploymentFor(options)),
      place_{options.program_folder, options.source_folder + "/config/sim", options.run_folder, options.seed},
      onboard_bus_(deployment_.OnboardUrl()),
      offboard_bus_(deployment_.OffboardUrl()),
      onboard_(onboard_bus_, schema_, clock_),
      offboard_(offboard_bus_, schema_, clock_),
      wheel_inbox_(onboard_.SubscribeAll(channels::kWheelCommand)),
      onboard_inbox_(onboard_.SubscribeAll(channels::kDriveCommand)),
      offboard_inbox_(offboard_.SubscribeAll(channels::kDriveCommand)),
      lease_inbox_(offboard_.SubscribeAll(channels::kLeaseRequest)),
      estop_inbox_(onboard_.SubscribeAll(channels::kEstop)),
      onboard_health_(onboard_.SubscribeAll(channels::kHealth)),
      offboard_health_(offboard_.SubscribeAll(channels::kHealth)),
      onboard_status_(onboard_.Subscribe(channels::kDriveStatus)),
      offboard_status_(offboard_.Subscribe(channels::kDriveStatus)),
      truth_(onboard_.Subscribe(channels::kWorldTruth)),
      wheel_state_(onboard_.Subscribe(channels::kWheelState)),
      offboard_link_(offboard_.Subscribe(channels::kLinkStatus)),
      mission_(offboard_.Subscribe(channels::kMissionStatus)),
      head_command_(onboard_.Subscribe(channels::kHeadCommand)),
      onboard_estop_(onboard_.Advertise(channels::kEstop)),
      offboard_estop_(offboard_.Advertise(channels::kEstop)),
      head_drive_(onboard_.Advertise(channels::kHeadDrive)),
      bulk_(offboard_, "BULK"),
      mouse_tty_(cli::MouseTty(place_)),
      mouse_(kFullScale) {
  offboard_.AdvertiseRaw("BULK");
  if (options.own_line)
    line_ = std::make_unique<StudyLine>(place_.run_folder + "/tty-onboard",
                                        place_.run_folder + "/tty-offboard", deployment_.line);
  supervisor_ = std::make_unique<cli::Supervisor>(Plan(), place_.run_folder, [](const std::string&) {});
}

DrivingRig::~DrivingRig() = default;

std::vector<cli::ProcessSpec> DrivingRig::Plan() const {
  auto plan = cli::PlanOf(deployment_, place_);
  for (cli::ProcessSpec& spec : plan) {
    if (options_.stable_after > Duration::zero()) spec.policy.stable_after = options_.stable_after;
    if (options_.patient) spec.policy.stopped = std::chrono::hours(1);
    const bool radio = spec.name.ends_with("-radio");
    if (radio && options_.own_line)
      spec.arguments.insert(spec.arguments.end(), {"--port", place_.run_folder + "/tty-" +
                                                                 spec.name.substr(0, spec.name.size() - 6)});
    if (spec.name == "onboard-robot" && options_.own_line)
      spec.arguments.insert(spec.arguments.end(),
                            {"--set", "state_file=" + place_.run_folder + "/robot-state"});
    if (radio && options_.saturated)
      spec.arguments.insert(
          spec.arguments.end(),
          {"--set", "link=" + WriteSaturatedLink(options_.source_folder + "/config/sim",
                                                 place_.run_folder + "/link-saturated.toml")});
  }
  return plan;
}

void DrivingRig::Start() {
  const auto ready = [this] {
    const bool has_mouse = std::any_of(healths.begin(), healths.end(), [](const auto& h) {
      return h.message.process == "teleop" && h.message.state == health_t::OK;
    });
    return supervisor_->AllReady() && mouse_.awake() && has_mouse && truth.at != Time{} &&
           offboard_status.at != Time{};
  };
  if (Until(ready, kStartWithin)) return;
  std::string missing;
  for (const auto& p : supervisor_->Report())
    missing += fmt::format(" {} {} {};", p.name, Text(p.state), p.reason);
  throw std::runtime_error("the deployment did not start:" + missing);
}

bool DrivingRig::Until(const std::function<bool()>& done, Duration most) {
  const Time end = clock_.Now() + most;
  while (clock_.Now() < end) {
    Step();
    if (done()) return true;
  }
  return false;
}

void DrivingRig::Wait(double seconds) {
  Until([] { return false; }, FromSeconds(seconds));
}

void DrivingRig::Step() {
  pollfd fds[] = {{onboard_bus_.fd(), POLLIN, 0},
                  {offboard_bus_.fd(), POLLIN, 0},
                  {mouse_tty_.fd(), POLLIN, 0},
                  {supervisor_frozen ? -1 : supervisor_->fd(), POLLIN, 0},
                  {signals_.fd(), POLLIN, 0}};
  poll(fds, std::size(fds), 1);
  if (fds[4].revents != 0) throw std::runtime_error("stopped by a signal");
  onboard_bus_.Drain();
  offboard_bus_.Drain();
  Collect();
  MoveMouse();
  if (options_.saturated) Saturate();
  if (!supervisor_frozen) supervisor_->Step(clock_.Now());
}

void DrivingRig::Collect() {
  const Time now = clock_.Now();
  Append(wheel_inbox_, now, wheels);
  Append(onboard_inbox_, now, onboard_commands);
  Append(offboard_inbox_, now, offboard_commands);
  Append(lease_inbox_, now, lease_requests);
  Append(estop_inbox_, now, onboard_estops);
  Append(onboard_health_, now, healths);
  Append(offboard_health_, now, healths);
  Replace(onboard_status_, now, onboard_status);
  Replace(offboard_status_, now, offboard_status);
  Replace(truth_, now, truth);
  Replace(wheel_state_, now, wheel_state);
  Replace(offboard_link_, now, offboard_link);
  Replace(mission_, now, mission);
  Replace(head_command_, now, head_command);
}

void DrivingRig::Forget() {
  wheels.clear();
  offboard_commands.clear();
  onboard_commands.clear();
  lease_requests.clear();
  onboard_estops.clear();
  healths.clear();
}

void DrivingRig::MoveMouse() {
  const auto bytes = mouse_tty_.Read(256);
  std::string heard(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!mouse_plugged) return;
  const Time now = clock_.Now();
  const std::string packets = mouse_.Hear(heard) + mouse_.Move(hand, now);
  if (packets.empty()) return;
  mouse_tty_.Write(std::as_bytes(std::span(packets)));
  if (told_ == hand) return;
  told_ = hand;
  mouse_spoke_ = now;
}

/// Long messages, each another one.
void DrivingRig::Saturate() {
  const Time now = clock_.Now();
  if (now < next_bulk_) return;
  next_bulk_ = now + milliseconds(20);
  health_t message{};
  message.utime = ToUtime(now);
  message.process = "bulk";
  message.text = fmt::format("{:096x}", rng.Below(1'000'000'000));
  bulk_.Publish(message);
}

bool DrivingRig::Grip() {
  LetGo();
  Wait(0.15);
  const Time pressed = clock_.Now();
  hand.buttons = kDeadMan;
  return Until(
      [&] {
        const drive_status_t& s = offboard_status.message;
        return offboard_status.at > pressed && FromUtime(s.utime) > pressed && !s.estop &&
               s.driver == lease_request_t::TELEOP;
      },
      milliseconds(5000));
}

bool DrivingRig::DriveAtFullSpeed() {
  if (!fast_) {
    hand.buttons = kDeadMan | kRangeKey;
    Wait(0.15);
    hand.buttons = kDeadMan;
    Wait(0.05);
    fast_ = true;
  }
  hand.axis[0] = truth.message.x_m > kMiddle_x ? -1 : 1;
  if (std::cos(truth.message.yaw_rad) < 0) hand.axis[0] = -hand.axis[0];
  const auto fast = [this] {
    return !wheels.empty() && std::abs(Forward(wheels.back().message)) > kPlateau * kFullSpeed;
  };
  if (!Until(fast, milliseconds(4000))) return false;
  Wait(0.1);
  return fast();
}

void DrivingRig::SayEstop(bool stop) {
  estop_t message{};
  message.utime = ToUtime(clock_.Now());
  message.action = stop ? estop_t::STOP : estop_t::REARM;
  message.driver = lease_request_t::CONSOLE;
  if (stop) {
    offboard_estop_.Publish(message);
  } else {
    onboard_estop_.Publish(message);
  }
}

bool DrivingRig::Rearm() {
  const Time begin = clock_.Now();
  SayEstop(false);
  return Until(
      [&] { return FromUtime(onboard_status.message.utime) > begin && !onboard_status.message.estop; },
      milliseconds(1000));
}

void DrivingRig::TurnHead() {
  head_drive_t message{};
  message.utime = ToUtime(clock_.Now());
  message.session = 77;
  message.sequence = ++head_wishes_ % 65536;
  message.time_to_live_s = 0.3;
  message.pan_rad_s = head_wishes_ % 2 == 0 ? 0.1 : -0.1;
  head_drive_.Publish(message);
}

pid_t DrivingRig::Pid(const std::string& name) const {
  for (const auto& p : supervisor_->Report())
    if (p.name == name) return p.pid;
  throw std::invalid_argument("no process " + name);
}

bool DrivingRig::IsReady(const std::string& name) const {
  const auto all = supervisor_->Report();
  return std::any_of(all.begin(), all.end(), [&](const cli::ProcessReport& p) {
    return p.name == name && p.state == cli::ProcessState::kReady;
  });
}

int DrivingRig::Starts(const std::string& name) const {
  for (const auto& p : supervisor_->Report())
    if (p.name == name) return p.starts;
  return 0;
}

int DrivingRig::AllStarts() const {
  int all = 0;
  for (const auto& p : supervisor_->Report()) all += p.starts;
  return all;
}

std::string DrivingRig::Reason(const std::string& name) const {
  for (const auto& p : supervisor_->Report())
    if (p.name == name) return p.reason;
  return "";
}

std::vector<std::string> DrivingRig::Names() const {
  std::vector<std::string> names;
  for (const auto& p : supervisor_->Report()) names.push_back(p.name);
  return names;
}

double DrivingRig::Forward(const wheel_command_t& c) {
  return (c.speed_rad_s[0] + c.speed_rad_s[1] + c.speed_rad_s[2] + c.speed_rad_s[3]) / 4;
}

}  // namespace priamos::bench
