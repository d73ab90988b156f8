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
  Finding Of(const std::string& what) {
    for (const auto& finding : Examine(machine_, "udpm://239.255.76.67:7667"))
      if (finding.what == what) return finding;
    ADD_FAILURE() << "nothing about " << what;
    return {};
  }
  TemporaryFolder folder_;
  Machine machine_;
};

TEST_F(Doctor, AMachineThatHasEverythingIsGood) {
  for (const auto& finding : Examine(machine_, "udpm://")) {
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

}  // namespace
}  // namespace priamos::cli
