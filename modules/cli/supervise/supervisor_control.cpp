#include "cli/supervise/supervisor_control.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace priamos::cli {
namespace {

constexpr Duration kAgain = std::chrono::seconds(1);
/// From the emergency stop to the end of the process that drives: it stands by then, and has it written down.
constexpr Duration kStandWithin = std::chrono::milliseconds(500);
/// What passes within this time is not told: the radio has a word for each process every 10 s.
constexpr Duration kPassing = std::chrono::seconds(2);
constexpr const char* kOffboard = "offboard";

process_state_t ToMessage(const ProcessReport& report, Time now) {
  process_state_t message{};
  message.utime = ToUtime(now);
  message.process = report.name;
  message.state = static_cast<std::int8_t>(report.state);
  message.starts = report.starts;
  message.alarm = report.alarm;
  return message;
}

bool IsPassing(const ProcessReport& report, Time now) {
  using enum ProcessState;
  const bool on_its_way = report.state == kWaiting || report.state == kStarting || report.state == kStopping;
  return on_its_way && now - report.since < kPassing;
}

bool SameState(const process_state_t& a, const process_state_t& b) {
  return a.state == b.state && a.starts == b.starts && a.alarm == b.alarm;
}

estop_t Stop(Time now) {
  estop_t message{};
  message.utime = ToUtime(now);
  message.action = estop_t::STOP;
  return message;
}

}  // namespace

static_assert(static_cast<int>(ProcessState::kStopped) == process_state_t::STOPPED);
static_assert(static_cast<int>(ProcessState::kBackOff) == process_state_t::BACK_OFF);

struct SupervisorControl::Channels {
  explicit Channels(const Side& side)
      : name(side.name),
        orders(side.node->SubscribeAll(channels::kProcessOrder)),
        reports(side.node->Advertise(channels::kProcessReport)),
        states(side.node->Advertise(channels::kProcessState)),
        simulations(side.node->Advertise(channels::kSimulation)),
        stop(side.node->Advertise(channels::kEstop)),
        desk(SupervisorDesk::Hands{}) {}
  std::string name;
  bus::Inbox<process_order_t> orders;
  bus::Publisher<process_report_t> reports;
  bus::Publisher<process_state_t> states;
  bus::Publisher<simulation_t> simulations;
  mutable bus::Publisher<estop_t> stop;
  SupervisorDesk desk;
  std::map<std::string, process_state_t> told;
  Time told_simulation{};
  int told_worlds = 0;
  std::int8_t told_state = -1;
};

SupervisorControl::SupervisorControl(const std::vector<Side>& sides, Supervisor& supervisor,
                                     Simulation simulation)
    : supervisor_(supervisor), simulation_(std::move(simulation)) {
  for (const Side& side : sides) {
    sides_.push_back(std::make_unique<Channels>(side));
    sides_.back()->desk = SupervisorDesk(HandsOf(*sides_.back()));
  }
}

SupervisorControl::~SupervisorControl() = default;

/// The emulated line belongs to neither bus: it is told where a person is.
std::string SupervisorControl::SideOf(const ProcessReport& process) const {
  const auto has = [&](const std::string& name) {
    return std::any_of(sides_.begin(), sides_.end(), [&](const auto& side) { return side->name == name; });
  };
  if (has(process.group)) return process.group;
  return has(kOffboard) ? kOffboard : sides_.front()->name;
}

SupervisorDesk::Hands SupervisorControl::HandsOf(const Channels& side) {
  SupervisorDesk::Hands hands;
  hands.look = [this, &side](const std::string& process) -> std::optional<ProcessReport> {
    const auto all = supervisor_.Report();
    const auto at = std::find_if(all.begin(), all.end(), [&](const ProcessReport& report) {
      return report.name == process && SideOf(report) == side.name;
    });
    return at == all.end() ? std::nullopt : std::optional(*at);
  };
  hands.restart = [this, &side](const std::string& process) { Restart(side, process); };
  hands.console = [this](const std::string& process, std::int64_t end_bytes) {
    return ReadConsolePiece(supervisor_.ConsoleFile(process), end_bytes, SupervisorDesk::kMostText);
  };
  if (side.name == kOffboard && !simulation_.offers.empty())
    hands.new_world = [this](const std::string& scenario) { return NewWorld(scenario); };
  return hands;
}

/// What drives ends when the base stands, and begins with its emergency stop latched: it does not know its
/// pose then, and a planner would repeat its path.
void SupervisorControl::Restart(const Channels& side, const std::string& process) {
  const auto all = supervisor_.Report();
  const auto report = std::find_if(all.begin(), all.end(), [&](const auto& r) { return r.name == process; });
  if (report->drives) {
    side.stop.Publish(Stop(now_));
    later_.push_back({process, now_ + kStandWithin});
  } else {
    supervisor_.Restart(process);
  }
}

bool SupervisorControl::NewWorld(const std::string& scenario) {
  const auto& offers = simulation_.offers;
  if (std::none_of(offers.begin(), offers.end(), [&](const auto& offer) { return offer.name == scenario; }))
    return false;
  if (!simulation_.begin(scenario)) return false;
  later_.clear();
  simulation_.scenario = scenario;
  ++worlds_;
  return true;
}

void SupervisorControl::Step(Time now) {
  now_ = now;
  for (const auto& side : sides_)
    for (const process_order_t& order : side->orders.Drain())
      if (const auto report = side->desk.Take(order, now)) side->reports.Publish(*report);
  for (const Later& later : later_)
    if (now >= later.at) supervisor_.Restart(later.process);
  std::erase_if(later_, [&](const Later& later) { return now >= later.at; });
  for (const auto& side : sides_)
    for (const process_report_t& answer : side->desk.Step(now)) side->reports.Publish(answer);
  const auto all = supervisor_.Report();
  for (const auto& side : sides_) {
    TellStates(*side, all, now);
    if (side->name == kOffboard && !simulation_.offers.empty()) TellSimulation(*side, now);
  }
}

void SupervisorControl::TellStates(Channels& side, const std::vector<ProcessReport>& all, Time now) {
  for (const ProcessReport& report : all) {
    if (SideOf(report) != side.name || IsPassing(report, now)) continue;
    const process_state_t state = ToMessage(report, now);
    const auto [told, first] = side.told.try_emplace(report.name, state);
    if (!first && SameState(told->second, state) && now - FromUtime(told->second.utime) < kAgain) continue;
    told->second = state;
    side.states.Publish(state);
  }
}

void SupervisorControl::TellSimulation(Channels& side, Time now) {
  const std::int8_t state = supervisor_.AllReady() ? simulation_t::RUNS : simulation_t::BEGINS;
  if (state == side.told_state && worlds_ == side.told_worlds && now - side.told_simulation < kAgain) return;
  side.told_state = state;
  side.told_worlds = worlds_;
  side.told_simulation = now;
  simulation_t message{};
  message.utime = ToUtime(now);
  message.scenario = simulation_.scenario;
  message.state = state;
  message.worlds = worlds_;
  for (const OfferedScenario& offer : simulation_.offers) {
    scenario_offer_t one{};
    one.name = offer.name;
    one.title = offer.title;
    message.scenarios.push_back(one);
  }
  message.n_scenarios = static_cast<std::int8_t>(message.scenarios.size());
  side.simulations.Publish(message);
}

}  // namespace priamos::cli
