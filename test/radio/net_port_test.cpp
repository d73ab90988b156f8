#include "radio/net_port.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "bus/clocks/clock.hpp"
#include "common/config.hpp"
#include "test/support/radio/bytes.hpp"

namespace priamos::radio {
namespace {

using support::Bytes;

using testing::HasSubstr;

/// Ports of this process: tests run side by side.
int Port(int which) {
  return 20000 + static_cast<int>(getpid() % 2400) * 5 + which;
}

Time Now() {
  return bus::MonotonicClock().Now();
}

/// Frames that arrive within two seconds, at least `n` if they come.
std::vector<NetFrame> ReadAll(NetPort& from, std::size_t n, NetPort* other = nullptr) {
  std::vector<NetFrame> all;
  for (int i = 0; i < 2000 && all.size() < n; ++i) {
    if (other != nullptr) other->Read(Now);
    for (NetFrame& frame : from.Read(Now)) all.push_back(std::move(frame));
    if (all.size() < n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return all;
}

std::unique_ptr<NetPort> Udp(int to, int local, bool loopback_only = true) {
  NetAddress address = ParseNetAddress(fmt::format("udp:127.0.0.1:{}@{}", Port(to), Port(local)));
  address.loopback_only = loopback_only;
  return OpenNetPort(address);
}

TEST(NetAddress, FormsAreRead) {
  const NetAddress udp = ParseNetAddress("udp:robot.local:9000");
  EXPECT_TRUE(udp.datagrams);
  EXPECT_EQ(udp.host, "robot.local");
  EXPECT_EQ(udp.port, "9000");
  EXPECT_EQ(udp.local_port, "9000");
  EXPECT_EQ(ParseNetAddress("udp:[::1]:9000@9001").host, "::1");
  EXPECT_EQ(ParseNetAddress("udp:[::1]:9000@9001").local_port, "9001");
  EXPECT_EQ(ParseNetAddress("tcp::9000").host, "");
}

TEST(NetAddress, OthersAreRefusedWithTheForms) {
  for (const char* wrong :
       {"udp:9000", "udp::9000", "tcp:host:", "tcp:host:70000", "tcp:host:1@2", "udp:h:x"}) {
    try {
      ParseNetAddress(wrong);
      ADD_FAILURE() << wrong;
    } catch (const ConfigError& e) {
      EXPECT_THAT(e.what(), HasSubstr("udp:HOST:PORT@LOCAL"));
    }
  }
  EXPECT_FALSE(IsNetPort("/dev/ttyUSB0"));
}

TEST(NetPort, UdpSendsAFramePerDatagram) {
  const auto a = Udp(0, 1), b = Udp(1, 0);
  a->Write(Bytes({0, 1, 2, 3, 4, 5}), Now());  // the delimiter alone is no frame, this one is not whole yet
  EXPECT_TRUE(b->Read(Now).empty());
  a->Write(Bytes({6, 7, 0, 11, 12, 13, 14, 15, 16, 17, 0}), Now());
  const auto frames = ReadAll(*b, 2);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].bytes, Bytes({1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(frames[1].bytes, Bytes({11, 12, 13, 14, 15, 16, 17}));
  EXPECT_FALSE(frames[0].stranger);
}

TEST(NetPort, UdpDropsWhatIsTooShortOrTooLongForAFrame) {
  const auto a = Udp(0, 1), b = Udp(1, 0);
  for (const std::size_t size : {4U, 252U, 6U, 251U}) {
    std::vector<std::byte> frame(size, std::byte{9});
    frame.push_back(std::byte{0});
    a->Write(frame, Now());
  }
  const auto frames = ReadAll(*b, 2);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].bytes.size(), 6U);
  EXPECT_EQ(frames[1].bytes.size(), 251U);
  EXPECT_GE(b->turned_away(), 2U);
}

TEST(NetPort, UdpFollowsTheOtherEndWhenAFreshFrameProvesIt) {
  const auto dut = Udp(1, 0), first = Udp(0, 1), second = Udp(0, 2);
  const auto arrives = [&](NetPort& at) { return !ReadAll(at, 1).empty(); };
  const auto frame = Bytes({1, 2, 3, 4, 5, 6, 7, 0});
  second->Write(frame, Now());
  auto frames = ReadAll(*dut, 1);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(frames[0].stranger);
  dut->Write(frame, Now());
  EXPECT_TRUE(arrives(*first));
  dut->Judge(frames[0], bus::radio::Proof::kGenuine);  // nobody was heard before: it may be the other end
  dut->Write(frame, Now());
  EXPECT_TRUE(arrives(*first));
  EXPECT_TRUE(arrives(*second));
  dut->Judge(frames[0], bus::radio::Proof::kFresh);
  dut->Write(frame, Now());
  EXPECT_TRUE(arrives(*second));
  EXPECT_TRUE(first->Read(Now).empty());
  second->Write(frame, Now());
  frames = ReadAll(*dut, 1);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_FALSE(frames[0].stranger);
}

TEST(NetPort, TcpConnectsAndConnectsAgain) {
  const auto server = OpenNetPort(ParseNetAddress(fmt::format("tcp::{}", Port(2))));
  const auto client = [] { return OpenNetPort(ParseNetAddress(fmt::format("tcp:127.0.0.1:{}", Port(2)))); };
  const auto arrives = [&](NetPort& from, int value) {
    for (int i = 0; i < 30; ++i) {
      from.Read(Now);
      from.Write(Bytes({value, 0}), Now());
      for (const NetFrame& frame : ReadAll(*server, 1, &from)) {
        if (frame.bytes != Bytes({value})) continue;
        server->Judge(frame, bus::radio::Proof::kFresh);
        return frame.stranger;
      }
    }
    return false;
  };
  const auto first = client();
  EXPECT_TRUE(arrives(*first, 7));
  EXPECT_FALSE(arrives(*first, 7));
  const auto second = client();
  EXPECT_TRUE(arrives(*second, 8));
  EXPECT_FALSE(arrives(*second, 8));
}

TEST(NetPort, AStrangersConnectionTakesNothingFromTheProvenOne) {
  const auto server = OpenNetPort(ParseNetAddress(fmt::format("tcp::{}", Port(2))));
  const std::string port = fmt::format("tcp:127.0.0.1:{}", Port(2));
  const auto peer = OpenNetPort(ParseNetAddress(port));
  peer->Read(Now);
  std::vector<NetFrame> frames;
  for (int i = 0; i < 500 && frames.empty(); ++i) {
    peer->Write(Bytes({5, 0}), Now());
    frames = ReadAll(*server, 1, peer.get());
  }
  ASSERT_FALSE(frames.empty());
  server->Judge(frames[0], bus::radio::Proof::kFresh);
  std::vector<std::unique_ptr<NetPort>> strangers;
  for (int i = 0; i < 300; ++i) {
    strangers.push_back(OpenNetPort(ParseNetAddress(port)));
    strangers.back()->Read(Now);
    strangers.back()->Write(std::vector<std::byte>(300, std::byte{1}), Now());
    server->Read(Now);
  }
  server->Write(Bytes({6, 0}), Now());
  const auto answer = ReadAll(*peer, 1);
  ASSERT_EQ(answer.size(), 1U);
  EXPECT_EQ(answer[0].bytes, Bytes({6}));
  for (const auto& stranger : strangers) EXPECT_TRUE(stranger->Read(Now).empty());
  EXPECT_GE(server->turned_away(), 40U);
}

TEST(NetPort, WhoWaitsForThisMachineAloneIsNotFoundElsewhere) {
  NetAddress address = ParseNetAddress(fmt::format("tcp::{}", Port(4)));
  for (const bool loopback_only : {false, true}) {
    address.loopback_only = loopback_only;
    const auto server = OpenNetPort(address);
    const auto client =
        OpenNetPort(ParseNetAddress(fmt::format("tcp:127.0.0.2:{}", Port(4))));  // not where it is bound
    std::size_t arrived = 0;
    for (int i = 0; i < 500 && arrived == 0; ++i) {
      client->Read(Now);
      client->Write(Bytes({9, 0}), Now());
      arrived = server->Read(Now).size();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(arrived > 0, !loopback_only);
  }
}

/// A name may be looked up as another address than when it was judged: then it is not used.
TEST(NetPort, AnAddressOfOthersIsRefusedForThisMachineAlone) {
  for (const char* port : {"udp:192.0.2.1:9000", "tcp:192.0.2.1:9000", "udp:[2001:db8::1]:9000"}) {
    NetAddress address = ParseNetAddress(port);
    address.loopback_only = true;
    try {
      OpenNetPort(address);
      FAIL() << port;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("expected an address of this machine")) << port;
    }
  }
}

TEST(NetPort, ATakenPortIsASentence) {
  const auto holder = OpenNetPort(ParseNetAddress(fmt::format("tcp::{}", Port(3))));
  try {
    OpenNetPort(ParseNetAddress(fmt::format("tcp::{}", Port(3))));
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("cannot be bound"));
  }
}

}  // namespace
}  // namespace priamos::radio
