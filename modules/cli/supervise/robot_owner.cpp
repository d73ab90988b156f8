#include "cli/supervise/robot_owner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bus/claim_messages.hpp"
#include "bus/wire/lcm_bus.hpp"

namespace priamos::cli {
namespace {

/// Long enough to hear everybody who holds a role, also when one word is lost.
constexpr Duration kAskFor{300'000};
constexpr std::size_t kMostAlarms = 20;
constexpr const char* kHostRole = "up-";

bool Starts(const Deployment& deployment, const std::string& side, const std::string& role) {
  return std::any_of(deployment.processes.begin(), deployment.processes.end(), [&](const auto& process) {
    return process.bus == side && StartsHere(deployment, process) && (role.empty() || process.module == role);
  });
}

/// Its supervisor is refused by name, so this is about processes without one.
void RefuseOthers(const std::vector<bus::ClaimWord>& others, const Deployment& deployment,
                  const std::string& side, Time now) {
  for (const bus::ClaimWord& other : others)
    if (Starts(deployment, side, other.who.role))
      throw bus::BusError(
          fmt::format("robot {}: expected nothing of it up, got {}; end that one first (`systemctl stop "
                      "priamos.target`, or kill {}), or give this robot another name with --robot",
                      deployment.robot, bus::Describe(other, now), other.who.pid));
}

}  // namespace

struct RobotOwner::Side {
  Side(std::string side, const std::string& url, const bus::Schema& schema, const bus::Clock& clock,
       const Deployment& deployment)
      : name(std::move(side)),
        bus(url),
        node(bus, schema, clock),
        alarms(node.SubscribeAll(channels::kAlarm)),
        claim(bus, schema, clock, bus::MakeClaimant(deployment.robot, SupervisorRole(deployment.host)),
              {{}, kAskFor}, [](bus::Level, std::string_view) {}) {}
  std::string name;
  bus::LcmBus bus;
  bus::Node node;
  bus::Inbox<alarm_t> alarms;
  bus::ClaimKeeper claim;
};

std::string SupervisorRole(const std::string& host) {
  return host.empty() ? kSupervisorRole : kHostRole + host;
}

bool IsSupervisorRole(std::string_view role) {
  return role == kSupervisorRole || role.starts_with(kHostRole);
}

std::string AlarmText(const alarm_t& alarm) {
  constexpr std::array<std::string_view, 3> kSeverity{"caution", "warning", "critical"};
  const auto severity = kSeverity[std::clamp<int>(alarm.severity, 0, kSeverity.size() - 1)];
  return fmt::format("ALARM ({}) of {}: {}", severity, alarm.source, alarm.text);
}

RobotOwner::RobotOwner(const Deployment& deployment, const bus::Schema& schema, const bus::Clock& clock,
                       Announce announce)
    : announce_(std::move(announce)) {
  for (const char* side : {"onboard", "offboard"})
    if (Starts(deployment, side, "")) Add(side, deployment, schema, clock);
}

RobotOwner::~RobotOwner() = default;

void RobotOwner::Add(const std::string& side, const Deployment& deployment, const bus::Schema& schema,
                     const bus::Clock& clock) {
  const std::string url = side == "onboard" ? deployment.OnboardUrl() : deployment.OffboardUrl();
  sides_.push_back(std::make_unique<Side>(side, url, schema, clock, deployment));
  RefuseOthers(sides_.back()->claim.others(), deployment, side, clock.Now());
}

void RobotOwner::Listen() {
  for (const auto& side : sides_) {
    side->bus.Drain();
    for (const alarm_t& alarm : side->alarms.Drain()) {
      alarms_.push_back(AlarmText(alarm));
      announce_(alarms_.back());
    }
  }
  if (alarms_.size() > kMostAlarms)
    alarms_.erase(alarms_.begin(), alarms_.end() - static_cast<std::ptrdiff_t>(kMostAlarms));
}

std::vector<std::pair<std::string, bus::Node*>> RobotOwner::nodes() const {
  std::vector<std::pair<std::string, bus::Node*>> nodes;
  for (const auto& side : sides_) nodes.emplace_back(side->name, &side->node);
  return nodes;
}

std::optional<std::string> RobotOwner::lost() const {
  for (const auto& side : sides_)
    if (auto why = side->claim.lost()) return why;
  return std::nullopt;
}

}  // namespace priamos::cli
