#include "bus/wire/udp_sender.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bus/wire/bus_error.hpp"
#include "bus/wire/datagram.hpp"

// Over a network: test/system/hosts/hosts_test.cpp.

namespace priamos::bus {
namespace {

std::vector<std::byte> Pattern(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 + i / 251);
  return bytes;
}

/// A socket on loopback, which gets what is sent to it alone.
class UdpSenderTest : public testing::Test {
 protected:
  UdpSenderTest() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address_), size), 0);
    getsockname(fd_, reinterpret_cast<sockaddr*>(&address_), &size);
  }
  ~UdpSenderTest() override { close(fd_); }
  std::uint64_t Name() const { return std::uint64_t{address_.sin_addr.s_addr} << 16 | address_.sin_port; }
  std::vector<std::byte> Received() const {
    std::vector<std::byte> bytes(1 << 16);
    const ssize_t n = recv(fd_, bytes.data(), bytes.size(), 0);
    bytes.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
    return bytes;
  }

  int fd_;
  sockaddr_in address_{};
  UdpSender dut_{"udpm://239.255.1.1:29999?ttl=0&network=lo"};
};

TEST_F(UdpSenderTest, AnAnswerIsOneDatagramForOneSocket) {
  const auto bytes = Pattern(100);
  ASSERT_TRUE(dut_.SendTo(Name(), "PROBE", bytes));
  const auto datagram = Received();
  std::uint32_t number = 99;
  std::string_view channel;
  std::span<const std::byte> message;
  ASSERT_TRUE(ParseDatagram(datagram, number, channel, message));
  EXPECT_EQ(channel, "PROBE");
  EXPECT_THAT(message, testing::ElementsAreArray(bytes));
}

TEST_F(UdpSenderTest, ANameThatNoReceiverTakesIsNotSent) {
  const auto bytes = Pattern(1);
  for (const std::string& wrong :
       {std::string(), std::string(64, 'A'), std::string("A\nB"), std::string("A\0B", 3)}) {
    EXPECT_FALSE(dut_.Send(wrong, bytes));
    EXPECT_FALSE(dut_.SendTo(Name(), wrong, bytes));
  }
  EXPECT_TRUE(dut_.Send(std::string(63, 'A'), bytes));
}

TEST(UdpSender, AWayThatIsNotThereIsASentence) {
  EXPECT_THROW(UdpSender("udpm://239.255.1.1:29999?network=eth77"), BusError);
  EXPECT_THROW(UdpSender("udpm://127.0.0.1:29999?network=lo"), BusError);
  EXPECT_THROW(UdpSender("udpm://239.255.1.1:29999?network=lo&ttl=1000"), BusError);
}

}  // namespace
}  // namespace priamos::bus
