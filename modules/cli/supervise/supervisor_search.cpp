#include "cli/supervise/supervisor_search.hpp"

#include <fmt/format.h>
#include <poll.h>

#include "bus/bus_choice.hpp"
#include "bus/claim_messages.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/wire/bus_error.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/supervise/robot_owner.hpp"
#include "cli/supervise/up_state.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

/// Two announcements of a holder, and time to hear them.
constexpr Duration kListenFor = 2 * bus::Claim::kAnnounce + Duration(100'000);

/// The claims on one bus.
struct Ear {
  Ear(const bus::BusChoice& choice, const bus::Schema& schema, const bus::Clock& clock)
      : bus(choice.Url()), node(bus, schema, clock), claims(node.SubscribeAll(channels::kClaim)) {}

  std::optional<bus::ClaimWord> Listen(const std::string& robot) {
    pollfd fd{bus.fd(), POLLIN, 0};
    poll(&fd, 1, 10);
    bus.Drain();
    for (const claim_t& message : claims.Drain())
      if (IsSupervisorRole(message.role) && message.robot == robot && message.state == claim_t::HOLDS)
        return bus::FromMessage(message);
    return std::nullopt;
  }

  bus::LcmBus bus;
  bus::Node node;
  bus::Inbox<claim_t> claims;
};

std::optional<bus::ClaimWord> Hear(const std::string& robot, const std::string& network,
                                   const bus::Clock& clock) {
  const bus::Schema schema = bus::OwnTypes();
  bus::BusChoice choice;
  choice.robot = robot;
  choice.network = network;
  choice.bus = "onboard";
  Ear onboard(choice, schema, clock);
  choice.bus = "offboard";
  Ear offboard(choice, schema, clock);
  for (const Time until = clock.Now() + kListenFor; clock.Now() < until;)
    for (Ear* ear : {&onboard, &offboard})
      if (auto word = ear->Listen(robot)) return word;
  return std::nullopt;
}

}  // namespace

std::optional<FoundSupervisor> FindSupervisor(const std::string& robot, const std::string& network) {
  const bus::HostClock clock;
  try {
    const auto word = Hear(robot, network, clock);
    if (!word) return std::nullopt;
    FoundSupervisor found{bus::Whereabouts(*word, clock.Now()), std::nullopt};
    if (word->who.host == bus::MakeClaimant(robot, kSupervisorRole).host)
      found.log_root = UpLock::FolderOf(word->who.pid);
    return found;
  } catch (const bus::BusError&) {
    return std::nullopt;
  }
}

std::string Describe(const FoundSupervisor& found, const std::string& robot) {
  const std::string place = found.log_root ? fmt::format("its state is in {0}: --logs {0}", *found.log_root)
                                           : "ask there, as the user who started it";
  return fmt::format("robot {} is up, but not from this folder of logs: {}; {}", robot, found.who, place);
}

}  // namespace priamos::cli
