#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/node.hpp"
#include "cli/supervise/scenario_choice.hpp"
#include "cli/supervise/supervisor.hpp"
#include "cli/supervise/supervisor_desk.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// What a supervisor tells on its buses, and the orders that it takes there: of onboard processes on the
/// onboard bus, from where the radio carries it, of all others on the offboard bus, as far as it has them.
class SupervisorControl {
 public:
  /// One of its buses, "onboard" or "offboard". The node must outlive this.
  struct Side {
    std::string name;
    bus::Node* node = nullptr;
  };
  /// A simulation that can begin anew. None are offered: there is none.
  struct Simulation {
    std::vector<OfferedScenario> offers;
    std::string scenario;  ///< of now
    /// Begins anew with an offer; false when it cannot.
    std::function<bool(const std::string& scenario)> begin;
  };

  /// `supervisor` must outlive this; what it supervises does not change.
  SupervisorControl(const std::vector<Side>& sides, Supervisor& supervisor, Simulation simulation);
  ~SupervisorControl();

  /// Takes orders, and tells what has changed or was told a second ago.
  void Step(Time now);

 private:
  struct Channels;
  struct Later {
    std::string process;
    Time at;
  };
  SupervisorDesk::Hands HandsOf(const Channels& side);
  std::string SideOf(const ProcessReport& process) const;
  void Restart(const Channels& side, const std::string& process);
  bool NewWorld(const std::string& scenario);
  void TellStates(Channels& side, const std::vector<ProcessReport>& all, Time now);
  void TellSimulation(Channels& side, Time now);

  Supervisor& supervisor_;
  Simulation simulation_;
  std::vector<std::unique_ptr<Channels>> sides_;
  std::vector<Later> later_;  ///< to be started again when the base stands
  Time now_{};
  int worlds_ = 1;
};

}  // namespace priamos::cli
