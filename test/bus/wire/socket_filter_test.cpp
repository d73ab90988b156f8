#include "bus/wire/socket_filter.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace priamos::bus {
namespace {

/// A receive socket on loopback, on a port the kernel chooses.
class FilterTest : public testing::Test {
 protected:
  void SetUp() override {
    receiver_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sender_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(bind(receiver_, reinterpret_cast<sockaddr*>(&address_), sizeof address_), 0);
    socklen_t size = sizeof address_;
    getsockname(receiver_, reinterpret_cast<sockaddr*>(&address_), &size);
  }
  void TearDown() override {
    close(receiver_);
    close(sender_);
  }
  bool Arrives(const std::string& datagram) {
    sendto(sender_, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&address_),
           sizeof address_);
    pollfd waiting{receiver_, POLLIN, 0};
    if (poll(&waiting, 1, 50) != 1) return false;
    char buffer[100];
    return recv(receiver_, buffer, sizeof buffer, 0) == static_cast<ssize_t>(datagram.size());
  }
  int receiver_ = -1, sender_ = -1;
  sockaddr_in address_{};
};

TEST_F(FilterTest, WithoutFilterFragmentsArrive) {
  EXPECT_TRUE(Arrives("LC03 a fragment"));
}

TEST_F(FilterTest, PassesMessagesAndStopsFragmentsAndRunts) {
  FilterSocket(receiver_);
  EXPECT_TRUE(Arrives("LC02 a message"));
  EXPECT_FALSE(Arrives("LC03 a fragment"));
  EXPECT_FALSE(Arrives("LC"));
  EXPECT_FALSE(Arrives(""));
}

TEST_F(FilterTest, WhatIsNoSocketIsASentence) {
  EXPECT_THROW(FilterSocket(-1), std::runtime_error);
}

}  // namespace
}  // namespace priamos::bus
