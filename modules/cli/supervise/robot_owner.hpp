#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/claim_keeper.hpp"
#include "bus/node.hpp"
#include "cli/supervise/deployment.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// The role of the supervisor of a robot's processes, on one of its buses.
inline constexpr const char* kSupervisorRole = "supervisor";
/// The same for one host of several, "up-vision": each host has a supervisor. `host` empty: kSupervisorRole.
std::string SupervisorRole(const std::string& host);
bool IsSupervisorRole(std::string_view role);

/// Holds a robot for as long as its processes are supervised: nobody else starts them beside it. Hears the
/// alarms of its buses meanwhile.
class RobotOwner {
 public:
  /// Function that is called with one line of text for each alarm.
  using Announce = std::function<void(const std::string&)>;

  /// Asks for 0.3 s on every bus on which `deployment` starts a process. Throws BusError that names who has
  /// the robot already: another supervisor, or one of the processes started by hand or by systemd. `announce`
  /// gets every alarm as one line.
  RobotOwner(const Deployment& deployment, const bus::Schema& schema, const bus::Clock& clock,
             Announce announce);
  ~RobotOwner();

  /// Takes what has come; to be called often.
  void Listen();
  /// Why the robot was lost to another supervisor that had it longer; nullopt while it is held.
  std::optional<std::string> lost() const;
  /// Its place on each bus, by the bus's side, "onboard" or "offboard".
  std::vector<std::pair<std::string, bus::Node*>> nodes() const;
  /// Newest last, at most 20.
  const std::vector<std::string>& alarms() const { return alarms_; }

 private:
  struct Side;
  void Add(const std::string& side, const Deployment& deployment, const bus::Schema& schema,
           const bus::Clock& clock);

  Announce announce_;
  std::vector<std::string> alarms_;
  std::vector<std::unique_ptr<Side>> sides_;
};

/// One line for a person: severity, source and text.
std::string AlarmText(const alarm_t& alarm);

}  // namespace priamos::cli
