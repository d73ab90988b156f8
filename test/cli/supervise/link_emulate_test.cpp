#include "cli/supervise/link_emulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "common/config.hpp"
#include "common/serial_port.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const Time kStart = FromUtime(1'000'000'000);

struct LinkEmulateTest : testing::Test {
  TemporaryFolder folder;
  LinkEmulateOptions options;
  void SetUp() override {
    options.a = (folder / "a").string();
    options.b = (folder / "b").string();
    options.line.latency_s = 0;
  }
};

TEST_F(LinkEmulateTest, BytesCrossAtTheBaudRate) {
  EmulatedLine dut(options, kStart);
  const auto a = OpenSerialPort(options.a, 9600), b = OpenSerialPort(options.b, 9600);
  const std::vector<std::byte> sent(96, std::byte{0x11});
  ASSERT_EQ(a->Write(sent), sent.size());
  dut.Step(kStart);
  dut.Step(kStart + std::chrono::milliseconds(50));
  std::array<std::byte, 200> got{};
  EXPECT_EQ(b->Read(got), 48U);
  dut.Step(kStart + std::chrono::milliseconds(100));
  EXPECT_EQ(b->Read(got), 48U);
  EXPECT_EQ(got[0], std::byte{0x11});
}

TEST_F(LinkEmulateTest, SurvivesTheProgramsAtItsEnds) {
  EmulatedLine dut(options, kStart);
  for (int i = 1; i <= 3; ++i) {
    const Time now = kStart + std::chrono::seconds(i);
    const auto a = OpenSerialPort(options.a, 9600), b = OpenSerialPort(options.b, 9600);
    const std::array<std::byte, 1> sent{static_cast<std::byte>(i)};
    b->Write(sent);
    dut.Step(now);
    dut.Step(now + std::chrono::milliseconds(10));
    std::array<std::byte, 8> got{};
    ASSERT_EQ(a->Read(got), 1U);
    EXPECT_EQ(got[0], sent[0]);
  }
}

TEST_F(LinkEmulateTest, LinksAreRemovedAtTheEnd) {
  {
    const EmulatedLine dut(options, kStart);
    EXPECT_TRUE(fs::exists(options.a));
    EXPECT_TRUE(fs::exists(options.b));
  }
  EXPECT_FALSE(fs::exists(fs::symlink_status(options.a)));
  EXPECT_FALSE(fs::exists(fs::symlink_status(options.b)));
}

TEST_F(LinkEmulateTest, ALinkLeftBehindIsReplacedAFileIsNot) {
  fs::create_symlink("/dev/pts/no-such", options.a);
  EXPECT_NO_THROW(EmulatedLine(options, kStart));
  std::ofstream(options.a) << "mine";
  EXPECT_THROW(EmulatedLine(options, kStart), std::runtime_error);
  EXPECT_TRUE(fs::exists(options.a));
}

TEST_F(LinkEmulateTest, BlackoutScheduleCutsTheLine) {
  options.blackouts = (folder / "blackouts.csv").string();
  std::ofstream(options.blackouts) << "from_s,to_s\n0.0,1.0\n# later\n5,6\n";
  EmulatedLine dut(options, kStart);
  const auto a = OpenSerialPort(options.a, 9600), b = OpenSerialPort(options.b, 9600);
  const std::array<std::byte, 1> sent{std::byte{1}};
  std::array<std::byte, 8> got{};
  a->Write(sent);
  dut.Step(kStart + std::chrono::milliseconds(500));
  dut.Step(kStart + std::chrono::milliseconds(600));
  EXPECT_EQ(b->Read(got), 0U);
  a->Write(sent);
  dut.Step(kStart + std::chrono::milliseconds(1500));
  dut.Step(kStart + std::chrono::milliseconds(1600));
  EXPECT_EQ(b->Read(got), 1U);
}

TEST_F(LinkEmulateTest, DelayScheduleHoldsOneWayAndLetsGo) {
  options.delays = (folder / "delays.csv").string();
  std::ofstream(options.delays) << "way,from_s,to_s,first_s,last_s\n# a stall\na_to_b,0,1.0,1.0,0\n";
  EmulatedLine dut(options, kStart);
  const auto a = OpenSerialPort(options.a, 9600), b = OpenSerialPort(options.b, 9600);
  const std::array<std::byte, 1> sent{std::byte{1}};
  std::array<std::byte, 8> got{};
  a->Write(sent);
  b->Write(sent);
  dut.Step(kStart + std::chrono::milliseconds(500));
  a->Write(sent);
  dut.Step(kStart + std::chrono::milliseconds(900));
  EXPECT_EQ(a->Read(got), 1U);
  EXPECT_EQ(b->Read(got), 0U);
  dut.Step(kStart + std::chrono::milliseconds(1010));
  EXPECT_EQ(b->Read(got), 2U);
}

TEST_F(LinkEmulateTest, RobotsOnAChannelHearEverybodyAndNothingWhileTheySend) {
  options.robots = 2;
  EmulatedChannel dut(options, kStart);
  const auto station = OpenSerialPort(options.a, 9600);
  const auto first = OpenSerialPort(options.b + "-1", 9600), second = OpenSerialPort(options.b + "-2", 9600);
  const std::array<std::byte, 1> sent{std::byte{0x55}};
  std::array<std::byte, 8> got{};
  station->Write(sent);
  dut.Step(kStart);
  dut.Step(kStart + std::chrono::milliseconds(5));
  EXPECT_EQ(first->Read(got), 1U);
  EXPECT_EQ(second->Read(got), 1U);
  EXPECT_EQ(got[0], sent[0]);
  // Both robots at once: neither is understood.
  first->Write(sent);
  second->Write(sent);
  dut.Step(kStart + std::chrono::milliseconds(100));
  dut.Step(kStart + std::chrono::milliseconds(105));
  const std::size_t n = station->Read(got);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NE(got[i], sent[0]);
  EXPECT_EQ(first->Read(got), 0U);
}

TEST_F(LinkEmulateTest, AWrongDelayNamesItsLine) {
  const std::string file = (folder / "delays.csv").string();
  for (const char* wrong :
       {"up,0,1,0.5,0.5", "both,1,1,0.5,0.5", "both,0,1,-1,0", "both,0,1,0.5", "both,0,1,0,0,0"}) {
    std::ofstream(file) << "# fine\n" << wrong << "\n";
    try {
      ReadDelays(file);
      ADD_FAILURE() << wrong;
    } catch (const ConfigError& e) {
      EXPECT_THAT(e.what(), HasSubstr("delays.csv:2: expected way,from_s,to_s,first_s,last_s"));
    }
  }
}

TEST_F(LinkEmulateTest, AWrongScheduleNamesItsLine) {
  options.blackouts = (folder / "blackouts.csv").string();
  std::ofstream(options.blackouts) << "0,1\n3,2\n";
  try {
    ReadBlackouts(options.blackouts);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_THAT(e.what(), HasSubstr("blackouts.csv:2: expected from_s,to_s"));
  }
}

}  // namespace
}  // namespace priamos::cli
