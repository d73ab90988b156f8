#include "cli/front/standard_output.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <optional>
#include <string>

#include "bus/real_time_loop.hpp"

namespace priamos::cli {
namespace {

/// What a program does whose standard output is `fd`: writes, and goes on when it is not ended. In a process
/// of its own, which ends with the code of Finish; 99: it was not told to end.
[[noreturn]] void WriteTo(int fd, bool watches_signals) {
  if (fd >= 0) dup2(fd, STDOUT_FILENO);
  if (fd < 0) close(STDOUT_FILENO);
  StandardOutput dut;
  const std::optional<bus::SignalWatch> signals =
      watches_signals ? std::optional<bus::SignalWatch>(std::in_place) : std::nullopt;
  const int socket = dup(STDERR_FILENO);  // must not get the number of standard output
  std::cout << "text" << std::endl;
  if (signals) {
    pollfd told{signals->fd(), POLLIN, 0};
    if (poll(&told, 1, 0) != 1) _exit(99);
  }
  const int code = dut.Finish("priamos try", socket == STDOUT_FILENO ? 98 : 1);
  _exit(code);
}

int ClosedPipe() {
  int ends[2];
  if (pipe(ends) != 0) return -1;
  close(ends[0]);
  return ends[1];
}

class StandardOutputTest : public testing::TestWithParam<bool> {};

TEST_P(StandardOutputTest, AFullDiskEndsItWithASentence) {
  EXPECT_EXIT(WriteTo(open("/dev/full", O_WRONLY), GetParam()), testing::ExitedWithCode(2),
              "^priamos try: standard output cannot be written: No space left on device; next: ");
}

TEST_P(StandardOutputTest, AClosedOneEndsItWithASentenceAndIsNoOtherFile) {
  EXPECT_EXIT(WriteTo(-1, GetParam()), testing::ExitedWithCode(2),
              "^priamos try: standard output cannot be written: Bad file descriptor; next: ");
}

TEST_P(StandardOutputTest, AReaderThatHasGoneEndsItQuietly) {
  EXPECT_EXIT(WriteTo(ClosedPipe(), GetParam()), testing::KilledBySignal(SIGPIPE), "^$");
}

INSTANTIATE_TEST_SUITE_P(, StandardOutputTest, testing::Bool(), [](const auto& watches) {
  return watches.param ? std::string("AVerbThatWatchesSignals") : std::string("AnyOtherVerb");
});

TEST(StandardOutput, WhatWasWrittenIsThereAndTheCodeStays) {
  testing::internal::CaptureStdout();
  {
    StandardOutput dut;
    std::cout << "one\n" << std::string(100'000, 'x') << '\n';
    EXPECT_EQ(dut.Finish("priamos try", 1), 1);
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "one\n" + std::string(100'000, 'x') + "\n");
  EXPECT_TRUE(std::cout.good());
}

}  // namespace
}  // namespace priamos::cli
