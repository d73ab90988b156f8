#include "cli/supervise/notify_socket.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

namespace priamos::cli {
namespace {

/// What sd_notify(3) does with the value of NOTIFY_SOCKET.
bool Notify(const std::string& name, const std::string& text) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, name.data(), name.size());
  address.sun_path[0] = '\0';
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto length = static_cast<socklen_t>(sizeof address.sun_family + name.size());
  const ssize_t sent =
      sendto(fd, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&address), length);
  close(fd);
  return sent == static_cast<ssize_t>(text.size());
}

TEST(NotifySocket, HasANameInTheAbstractNamespaceOfItsOwn) {
  const NotifySocket a, b;
  EXPECT_EQ(a.name().front(), '@');
  EXPECT_NE(a.name(), b.name());
}

TEST(NotifySocket, WithoutAWordThereIsNothing) {
  EXPECT_TRUE(NotifySocket().Read().empty());
}

TEST(NotifySocket, ReadyAndWatchdogAreTold) {
  NotifySocket dut;
  ASSERT_TRUE(Notify(dut.name(), "READY=1"));
  ASSERT_TRUE(Notify(dut.name(), "WATCHDOG=1\n"));
  ASSERT_TRUE(Notify(dut.name(), "STATUS=busy\nREADY=1\nWATCHDOG=1"));
  const auto messages = dut.Read();
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_TRUE(messages[0].ready && !messages[0].alive);
  EXPECT_TRUE(!messages[1].ready && messages[1].alive);
  EXPECT_TRUE(messages[2].ready && messages[2].alive);
  EXPECT_EQ(messages[0].status + messages[1].status, "");
  EXPECT_EQ(messages[2].status, "busy");
  EXPECT_TRUE(dut.Read().empty()) << "each is read once";
}

TEST(NotifySocket, OnlyAWholeLineCounts) {
  NotifySocket dut;
  for (const char* text : {"NOT_READY=1", "READY=10", "READY=0", "STATUS=READY=1", "\n\n", " READY=1"})
    ASSERT_TRUE(Notify(dut.name(), text)) << text;
  for (const NotifySocket::Message& message : dut.Read()) EXPECT_FALSE(message.ready || message.alive);
}

TEST(NotifySocket, TheKernelSaysWhoItWas) {
  NotifySocket dut;
  ASSERT_TRUE(Notify(dut.name(), "READY=1"));
  EXPECT_EQ(dut.Read().at(0).pid, getpid());
  const pid_t child = fork();
  if (child == 0) _exit(Notify(dut.name(), "READY=1") ? 0 : 1);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(dut.Read().at(0).pid, child);
}

TEST(NotifySocket, ALongTextIsCutAndDoesNoHarm) {
  NotifySocket dut;
  ASSERT_TRUE(Notify(dut.name(), "READY=1\nSTATUS=" + std::string(4000, 'x')));
  const auto messages = dut.Read();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(messages[0].ready);
}

}  // namespace
}  // namespace priamos::cli
