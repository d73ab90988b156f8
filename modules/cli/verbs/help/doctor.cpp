#include "cli/verbs/help/doctor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/timex.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "bus/clocks/host_clock.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/multicast.hpp"
#include "cli/options/folder_options.hpp"

namespace priamos::cli {
namespace {

using Verdict = Finding::Verdict;

constexpr long long kReceiveBuffer = 2 << 20;
constexpr std::uintmax_t kDiskMegabytes = 1000;

std::string ReadWord(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

Finding Route(const Machine& machine, const std::string& bus) {
  const std::string problem = machine.route_problem(bus);
  if (problem.empty()) return {"multicast route", Verdict::kGood, "there is one for " + bus, ""};
  if (!bus::NetworkOf(bus).empty())
    return {"multicast route", Verdict::kBad, problem,
            "ip -brief address   # lists the interfaces of this machine"};
  return {"multicast route", Verdict::kBad, problem,
          "sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo"};
}

/// The interfaces by which another host could be reached.
std::vector<bus::NetworkInterface> Outward(const Machine& machine) {
  auto all = machine.interfaces();
  std::erase_if(all, [](const auto& one) {
    return one.loopback || !one.up || !one.carrier || !one.multicast || one.addresses.empty();
  });
  return all;
}

std::string Listed(const std::vector<bus::NetworkInterface>& interfaces) {
  std::vector<std::string> texts;
  texts.reserve(interfaces.size());
  for (const auto& one : interfaces)
    texts.push_back(fmt::format("{} ({})", one.name, fmt::join(one.addresses, ", ")));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// Messages of the bus leave by `way`, which the URL named or the route.
Finding ReachBy(const std::string& way, const Machine& machine, const std::string& bus, bool other_hosts) {
  constexpr const char* kWhat = "other hosts";
  auto outward = Outward(machine);
  const auto is_way = [&](const auto& one) { return one.name == way; };
  const bool leads_out = std::any_of(outward.begin(), outward.end(), is_way);
  const std::string name_one =
      fmt::format("export PRIAMOS_NETWORK={}   # or onboard_network in deployment.toml",
                  outward.empty() ? "eth0" : outward.front().name);
  if (!leads_out)
    return {kWhat, other_hosts || !outward.empty() ? Verdict::kBad : Verdict::kNotNeededYet,
            fmt::format("messages leave by {}, which reaches none; those that could: {}",
                        way.empty() ? "no interface" : way,
                        outward.empty() ? "none has cable and address" : Listed(outward)),
            name_one};
  if (const bool named = !bus::NetworkOf(bus).empty(); named || outward.size() == 1)
    return {kWhat, Verdict::kGood, fmt::format("messages leave by {}, ttl {}", way, bus::TtlOf(bus)), ""};
  std::erase_if(outward, is_way);
  return {kWhat, Verdict::kNotNeededYet,
          fmt::format("messages leave by {}, because the route for multicast leads there, and are heard only "
                      "there; also here: {}",
                      way, Listed(outward)),
          fmt::format("export PRIAMOS_NETWORK={}   # if the other hosts are there; or onboard_network in "
                      "deployment.toml",
                      outward.front().name)};
}

/// Whether what this host sends can reach another one.
Finding Reach(const Machine& machine, const std::string& bus, bool other_hosts) {
  constexpr const char* kWhat = "other hosts";
  if (!bus.starts_with("udpm://")) return {kWhat, Verdict::kGood, bus + " is no bus of several", ""};
  if (bus::TtlOf(bus) == 0)
    return {kWhat, other_hosts ? Verdict::kBad : Verdict::kNotNeededYet,
            "with ttl 0 messages stay on this host, and no other one hears them",
            "export PRIAMOS_TTL=1   # or --ttl 1, or onboard_ttl = 1 in deployment.toml"};
  const std::string network = bus::NetworkOf(bus);
  if (network.empty()) return ReachBy(machine.route_interface(bus::GroupOf(bus)), machine, bus, other_hosts);
  for (const auto& one : machine.interfaces())
    if (one.name == network ||
        std::find(one.addresses.begin(), one.addresses.end(), network) != one.addresses.end())
      return ReachBy(one.name, machine, bus, other_hosts);
  return ReachBy(network, machine, bus, other_hosts);
}

/// Only needed when the route leads to loopback, as on a machine without a network.
Finding LoopbackFlag(const Machine& machine) {
  if (machine.loopback_has_multicast())
    return {"multicast on loopback", Verdict::kGood, "lo has the flag", ""};
  return {"multicast on loopback", Verdict::kNotNeededYet,
          "lo lacks the flag; needed without a network (demo and tests bring their own)",
          "sudo ip link set lo multicast on"};
}

Finding ReceiveBuffer(const Machine& machine) {
  const std::string word = ReadWord(machine.root / "proc/sys/net/core/rmem_max");
  const long long bytes = std::atoll(word.c_str());
  if (bytes >= kReceiveBuffer) return {"receive buffer", Verdict::kGood, fmt::format("{} bytes", bytes), ""};
  return {"receive buffer", Verdict::kNotNeededYet,
          fmt::format("{} bytes; a bus with thousands of messages per second wants {}",
                      word.empty() ? "unknown" : word, kReceiveBuffer),
          fmt::format("sudo sysctl -w net.core.rmem_max={}", kReceiveBuffer)};
}

Finding Java(const Machine& machine) {
  std::vector<std::string> missing;
  if (!machine.has_program("java")) missing.push_back("default-jre");
  if (!std::filesystem::exists(machine.root / "usr/share/java/lcm.jar")) missing.push_back("liblcm-java");
  if (!std::filesystem::exists(machine.root / "usr/share/java/jchart2d.jar"))
    missing.push_back("libjchart2d-java");
  if (missing.empty()) return {"Java", Verdict::kGood, "java, lcm.jar and jchart2d.jar are there", ""};
  const std::string packages = fmt::format("{}", fmt::join(missing, " "));
  return {"Java", Verdict::kNotNeededYet,
          "missing: " + packages + "; priamos-spy and priamos-logplayer want it",
          "sudo apt-get install " + packages};
}

Finding SerialRights(const Machine& machine) {
  std::vector<std::string> ports, refused;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(machine.root / "dev", none)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("ttyUSB") && !name.starts_with("ttyACM") && !name.starts_with("ttyAMA")) continue;
    ports.push_back(name);
    if (!machine.may_write(entry.path())) refused.push_back(name);
  }
  std::sort(ports.begin(), ports.end());
  std::sort(refused.begin(), refused.end());
  if (ports.empty())
    return {"serial ports", Verdict::kNotNeededYet, "none; a radio on USB shows up as /dev/ttyUSB0",
            "sudo dmesg --follow   # then plug the radio in"};
  if (refused.empty()) return {"serial ports", Verdict::kGood, fmt::format("{}", fmt::join(ports, " ")), ""};
  return {"serial ports", Verdict::kBad, fmt::format("no right to use {}", fmt::join(refused, " ")),
          "sudo adduser $USER dialout   # then log in again"};
}

Finding SpaceMouse(const Machine& machine) {
  if (std::filesystem::exists(machine.root / "run/spnav.sock") ||
      std::filesystem::exists(machine.root / "var/run/spnav.sock"))
    return {"spacenavd", Verdict::kGood, "it runs", ""};
  return {"spacenavd", Verdict::kNotNeededYet, "it does not run; only driving by SpaceMouse wants it",
          machine.has_program("spacenavd") ? "sudo systemctl enable --now spacenavd"
                                           : "sudo apt-get install spacenavd"};
}

/// The folder itself, or the one that it will be made in.
std::filesystem::path Existing(std::filesystem::path folder) {
  std::error_code error;
  while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

Finding Disk(const Machine& machine) {
  std::error_code error;
  const std::filesystem::path folder = Existing(std::filesystem::absolute(machine.disk));
  const auto space = std::filesystem::space(folder, error);
  if (error)
    return {"disk", Verdict::kBad, machine.disk.string() + ": " + error.message(),
            "df -h   # choose another place"};
  const auto megabytes = space.available / 1'000'000;
  if (!machine.may_write(folder))
    return {"disk", Verdict::kBad, machine.disk.string() + " cannot be written",
            "export PRIAMOS_LOGS=$HOME/logs   # or another folder of yours"};
  if (megabytes >= kDiskMegabytes) return {"disk", Verdict::kGood, fmt::format("{} MB free", megabytes), ""};
  return {"disk", Verdict::kBad, fmt::format("{} MB free; logs want {}", megabytes, kDiskMegabytes),
          "du -sh logs/* | sort -h   # and delete old ones"};
}

Finding ClockSync(const Machine& machine) {
  if (machine.clock_synchronised()) return {"clock", Verdict::kGood, "it is synchronised", ""};
  return {"clock", Verdict::kNotNeededYet,
          "it is not synchronised; only the dates of logs suffer, `priamos log merge` finds the offset",
          "sudo timedatectl set-ntp true"};
}

/// Whether the stamps of this host's processes are those of its wall clock.
Finding Anchor(const Machine& machine) {
  constexpr double kClose_s = 1;
  const ClockState state = machine.host_clock();
  if (!state.problem.empty())
    return {"clock of processes", Verdict::kBad,
            "each has its own, and a wall clock that is set separates them: " + state.problem,
            "ls -ld /run/priamos /tmp/priamos-*   # remove what is no folder of yours, and start all again"};
  if (std::abs(state.wall_ahead_s) < kClose_s)
    return {"clock of processes", Verdict::kGood, "all agree, with the wall clock too", ""};
  return {"clock of processes", Verdict::kNotNeededYet,
          fmt::format(
              "all agree, but the wall clock was set since the first one started: it is {:.1f} s {}, which "
              "dates of logs show",
              std::abs(state.wall_ahead_s), state.wall_ahead_s > 0 ? "ahead" : "behind"),
          fmt::format("rm {}   # and start all processes of this host again", state.file)};
}

/// Asks the kernel about the network this process is in; /sys shows the one it was mounted in.
bool LoopbackHasMulticast() {
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool answered = fd >= 0 && ioctl(fd, SIOCGIFFLAGS, &request) == 0;
  if (fd >= 0) close(fd);
  return answered && (request.ifr_flags & IFF_MULTICAST) != 0;
}

bool InPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

Machine ThisMachine() {
  Machine machine;
  machine.disk = LogRoot("");
  machine.route_problem = [](const std::string& bus) -> std::string {
    try {
      if (bus.starts_with("udpm://")) bus::RequireMulticastUrl(bus);
      if (bus.starts_with("udpm://")) bus::RequireMulticastRoute(bus);
      return "";
    } catch (const bus::BusError& error) {
      const std::string text = error.what();
      return text.substr(0, text.find(';'));
    }
  };
  machine.loopback_has_multicast = LoopbackHasMulticast;
  machine.has_program = InPath;
  machine.clock_synchronised = [] {
    timex state{};
    const int clock = adjtimex(&state);
    return clock >= 0 && clock != TIME_ERROR && !(state.status & STA_UNSYNC);
  };
  machine.interfaces = bus::NetworkInterfaces;
  machine.route_interface = bus::InterfaceOfRoute;
  machine.host_clock = [] {
    const bus::HostClock clock;
    return ClockState{Seconds(clock.WallAhead()), clock.anchor().file, clock.anchor().problem};
  };
  machine.may_write = [](const std::filesystem::path& path) {
    return access(path.c_str(), R_OK | W_OK) == 0;
  };
  return machine;
}

std::vector<Finding> Examine(const Machine& machine, const std::string& bus, bool other_hosts) {
  return {Route(machine, bus),   Reach(machine, bus, other_hosts),
          LoopbackFlag(machine), ReceiveBuffer(machine),
          Disk(machine),         SerialRights(machine),
          ClockSync(machine),    Anchor(machine),
          Java(machine),         SpaceMouse(machine)};
}

}  // namespace priamos::cli
