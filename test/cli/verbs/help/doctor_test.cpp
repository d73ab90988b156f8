#include "cli/verbs/help/doctor.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using Verdict = Finding::Verdict;

class Doctor : public testing::Test {
 protected:
  Doctor() {
    machine_.root = folder_.path();
    machine_.disk = folder_.path();
    machine_.route_problem = [](const std::string&) { return std::string(); };
    machine_.has_program = [](const std::string&) { return true; };
    machine_.clock_synchronised = [] { return true; };
    machine_.may_write = [](const std::filesystem::path&) { return true; };
    machine_.loopback_has_multicast = [] { return true; };
    machine_.interfaces = [this] { return interfaces_; };
    machine_.route_interface = [this](const std::string&) { return route_; };
    machine_.host_clock = [] { return ClockState{0.01, "/run/priamos/clock-1", ""}; };
    Write("proc/sys/net/core/rmem_max", "4194304");
    Write("dev/ttyUSB0", "");
    Write("usr/share/java/lcm.jar", "");
    Write("usr/share/java/jchart2d.jar", "");
    Write("run/spnav.sock", "");
  }
  void Write(const std::string& file, const std::string& text) {
    const auto path = folder_.path() / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void Remove(const std::string& file) { std::filesystem::remove(folder_.path() / file); }
  Finding Of(const std::string& what, const std::string& bus = "udpm://239.255.76.67:7667?ttl=1",
             bool other_hosts = false) {
    for (const auto& finding : Examine(machine_, bus, other_hosts))
      if (finding.what == what) return finding;
    ADD_FAILURE() << "nothing about " << what;
    return {};
  }
  Finding Reach(const std::string& parameters, bool other_hosts = false) {
    return Of("other hosts", "udpm://239.255.1.67:20000?" + parameters, other_hosts);
  }
  TemporaryFolder folder_;
  Machine machine_;
  bus::NetworkInterface lo_{1, "lo", {"127.0.0.1"}, true, true, false, true};
  bus::NetworkInterface eth0_{2, "eth0", {"10.0.0.5"}, true, true, true, false};
  bus::NetworkInterface eth1_{3, "eth1", {"10.77.0.1"}, true, true, true, false};
  std::vector<bus::NetworkInterface> interfaces_{lo_, eth0_};
  std::string route_ = "eth0";
};

TEST_F(Doctor, AMachineThatHasEverythingIsGood) {
  for (const auto& finding : Examine(machine_, "udpm://?ttl=1", true)) {
    if (finding.what == "disk") continue;  // this machine's own
    EXPECT_EQ(finding.verdict, Verdict::kGood) << finding.what << ": " << finding.found;
    EXPECT_EQ(finding.command, "") << finding.what;
  }
}

TEST_F(Doctor, MissingRouteIsBad) {
  machine_.route_problem = [](const std::string&) { return std::string("Network is unreachable"); };
  EXPECT_EQ(Of("multicast route").verdict, Verdict::kBad);
  EXPECT_THAT(Of("multicast route").command, HasSubstr("ip route add 224.0.0.0/4 dev lo"));
}

TEST_F(Doctor, LoopbackWithoutMulticast) {
  machine_.loopback_has_multicast = [] { return false; };
  EXPECT_EQ(Of("multicast on loopback").verdict, Verdict::kNotNeededYet);
  EXPECT_THAT(Of("multicast on loopback").command, HasSubstr("ip link set lo multicast on"));
}

TEST_F(Doctor, SmallReceiveBuffer) {
  Write("proc/sys/net/core/rmem_max", "212992");
  EXPECT_THAT(Of("receive buffer").command, HasSubstr("sysctl -w net.core.rmem_max="));
}

TEST_F(Doctor, NoRightToUseTheSerialPort) {
  machine_.may_write = [](const std::filesystem::path& path) { return path.filename() != "ttyUSB0"; };
  EXPECT_EQ(Of("serial ports").verdict, Verdict::kBad);
  EXPECT_THAT(Of("serial ports").found, HasSubstr("ttyUSB0"));
  EXPECT_THAT(Of("serial ports").command, HasSubstr("adduser $USER dialout"));
}

TEST_F(Doctor, NoSerialPort) {
  Remove("dev/ttyUSB0");
  EXPECT_EQ(Of("serial ports").verdict, Verdict::kNotNeededYet);
}

TEST_F(Doctor, MissingJavaPackagesAreNamed) {
  Remove("usr/share/java/jchart2d.jar");
  EXPECT_EQ(Of("Java").command, "sudo apt-get install libjchart2d-java");
}

TEST_F(Doctor, SpaceMouseDaemon) {
  Remove("run/spnav.sock");
  EXPECT_THAT(Of("spacenavd").command, HasSubstr("systemctl enable --now spacenavd"));
  machine_.has_program = [](const std::string& name) { return name != "spacenavd"; };
  EXPECT_THAT(Of("spacenavd").command, HasSubstr("apt-get install spacenavd"));
}

TEST_F(Doctor, ADiskThatCannotBeWritten) {
  machine_.may_write = [this](const std::filesystem::path& path) { return path != machine_.disk; };
  EXPECT_EQ(Of("disk").verdict, Verdict::kBad);
  machine_.may_write = [this](const std::filesystem::path& path) { return path != folder_.path(); };
  machine_.disk = folder_ / "runs/to be made";
  EXPECT_EQ(Of("disk").verdict, Verdict::kBad) << "that is where it would be made";
  EXPECT_THAT(Of("disk").command, HasSubstr("PRIAMOS_LOGS"));
}

TEST_F(Doctor, UnsynchronisedClock) {
  machine_.clock_synchronised = [] { return false; };
  EXPECT_THAT(Of("clock").command, HasSubstr("set-ntp true"));
}

TEST_F(Doctor, WithTtl0NoOtherHostHears) {
  EXPECT_EQ(Reach("ttl=0").verdict, Verdict::kNotNeededYet);
  EXPECT_EQ(Reach("ttl=0", true).verdict, Verdict::kBad) << "another host is expected";
  EXPECT_THAT(Reach("ttl=0").found, HasSubstr("stay on this host"));
  EXPECT_THAT(Reach("ttl=0").command, HasSubstr("export PRIAMOS_TTL=1"));
}

TEST_F(Doctor, WhereSeveralInterfacesAreTheOneOfTheRouteIsNamed) {
  interfaces_.push_back(eth1_);
  const Finding finding = Reach("ttl=1");
  EXPECT_EQ(finding.verdict, Verdict::kNotNeededYet);
  EXPECT_THAT(finding.found, HasSubstr("leave by eth0, because the route for multicast leads there"));
  EXPECT_THAT(finding.found, HasSubstr("also here: eth1 (10.77.0.1)"));
  EXPECT_THAT(finding.command, HasSubstr("export PRIAMOS_NETWORK=eth1"));
  EXPECT_EQ(Reach("ttl=1&network=eth1").verdict, Verdict::kGood);
  EXPECT_EQ(Reach("ttl=1&network=10.77.0.1").verdict, Verdict::kGood);
}

TEST_F(Doctor, ARouteToLoopbackReachesNobody) {
  route_ = "lo";
  EXPECT_EQ(Reach("ttl=1").verdict, Verdict::kBad);
  EXPECT_THAT(Reach("ttl=1").found,
              HasSubstr("leave by lo, which reaches none; those that could: eth0 (10.0.0.5)"));
  EXPECT_THAT(Reach("ttl=1").command, HasSubstr("PRIAMOS_NETWORK=eth0"));
  interfaces_ = {lo_};
  EXPECT_EQ(Reach("ttl=1").verdict, Verdict::kNotNeededYet) << "a machine without a network";
  EXPECT_EQ(Reach("ttl=1", true).verdict, Verdict::kBad);
}

TEST_F(Doctor, AnInterfaceWithoutCableOrAddressReachesNobody) {
  eth1_.carrier = false;
  interfaces_.push_back(eth1_);
  EXPECT_EQ(Reach("ttl=1&network=eth1").verdict, Verdict::kBad);
  EXPECT_EQ(Reach("ttl=1").verdict, Verdict::kGood) << "it is no other way";
  EXPECT_EQ(Reach("ttl=1&network=eth7").verdict, Verdict::kBad);
}

TEST_F(Doctor, AWallClockThatWasSetIsSeen) {
  machine_.host_clock = [] { return ClockState{3600, "/run/priamos/clock-1", ""}; };
  EXPECT_EQ(Of("clock of processes").verdict, Verdict::kNotNeededYet);
  EXPECT_THAT(Of("clock of processes").found, HasSubstr("3600.0 s ahead"));
  EXPECT_THAT(Of("clock of processes").command, HasSubstr("rm /run/priamos/clock-1"));
  machine_.host_clock = [] {
    return ClockState{0, "", "/tmp/priamos-0: expected a folder, got something else"};
  };
  EXPECT_EQ(Of("clock of processes").verdict, Verdict::kBad);
}

}  // namespace
}  // namespace priamos::cli
