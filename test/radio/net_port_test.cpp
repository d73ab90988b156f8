#include "radio/net_port.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "common/config.hpp"

namespace priamos::radio {
namespace {

using testing::HasSubstr;

/// Ports of this process: tests run side by side.
int Port(int which) {
  return 20000 + static_cast<int>(getpid() % 2400) * 5 + which;
}

std::vector<std::byte> Bytes(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
  return bytes;
}

/// What arrives within two seconds, at least `n` bytes if they come.
std::vector<std::byte> ReadAll(ByteStream& from, std::size_t n, ByteStream* other = nullptr) {
  std::vector<std::byte> all;
  std::array<std::byte, 64> buffer{};
  for (int i = 0; i < 2000 && all.size() < n; ++i) {
    if (other != nullptr) other->Read({});
    const std::size_t got = from.Read(buffer);
    all.insert(all.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(got));
    if (got == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return all;
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
  const auto a = OpenNetPort(
      ParseNetAddress("udp:127.0.0.1:" + std::to_string(Port(0)) + "@" + std::to_string(Port(1))));
  const auto b = OpenNetPort(
      ParseNetAddress("udp:127.0.0.1:" + std::to_string(Port(1)) + "@" + std::to_string(Port(0))));
  a->Write(Bytes({0, 1, 2}));  // the delimiter alone is no frame, this one is not whole yet
  std::array<std::byte, 8> buffer{};
  EXPECT_EQ(b->Read(buffer), 0U);
  a->Write(Bytes({3, 0, 4, 0}));
  EXPECT_EQ(ReadAll(*b, 6), Bytes({1, 2, 3, 0, 4, 0}));
}

TEST(NetPort, TcpConnectsAndConnectsAgain) {
  const std::string port = std::to_string(Port(2));
  auto server = OpenNetPort(ParseNetAddress("tcp::" + port));
  auto client = OpenNetPort(ParseNetAddress("tcp:127.0.0.1:" + port));
  const auto arrives = [&](std::byte value) {
    for (int i = 0; i < 30; ++i) {
      client->Read({});
      client->Write(std::array<std::byte, 1>{value});
      for (const std::byte b : ReadAll(*server, 1, client.get()))
        if (b == value) return true;
    }
    return false;
  };
  EXPECT_TRUE(arrives(std::byte{7}));
  client = OpenNetPort(ParseNetAddress("tcp:127.0.0.1:" + port));
  EXPECT_TRUE(arrives(std::byte{8}));
}

TEST(NetPort, WhoWaitsForThisMachineAloneIsNotFoundElsewhere) {
  const std::string port = std::to_string(Port(4));
  NetAddress address = ParseNetAddress("tcp::" + port);
  for (const bool loopback_only : {false, true}) {
    address.loopback_only = loopback_only;
    const auto server = OpenNetPort(address);
    const auto client = OpenNetPort(ParseNetAddress("tcp:127.0.0.2:" + port));  // not where it is bound
    std::array<std::byte, 1> byte{std::byte{9}};
    std::size_t arrived = 0;
    for (int i = 0; i < 500 && arrived == 0; ++i) {
      client->Read({});
      client->Write(byte);
      arrived = server->Read(byte);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(arrived, loopback_only ? 0u : 1u);
  }
}

TEST(NetPort, ATakenPortIsASentence) {
  const auto holder = OpenNetPort(ParseNetAddress("tcp::" + std::to_string(Port(3))));
  try {
    OpenNetPort(ParseNetAddress("tcp::" + std::to_string(Port(3))));
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("cannot be bound"));
  }
}

}  // namespace
}  // namespace priamos::radio
