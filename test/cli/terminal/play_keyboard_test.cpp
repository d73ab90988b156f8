#include "cli/terminal/play_keyboard.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

// With a terminal: test/system.

namespace priamos::cli {
namespace {

TEST(PlayKeyboard, WithoutATerminalThereAreNoKeys) {
  const int before = dup(STDIN_FILENO), nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  {
    PlayKeyboard dut;
    EXPECT_EQ(dut.fd(), -1) << "which poll leaves out";
    EXPECT_EQ(dut.Read(), "");
    dut.Keep();
    EXPECT_EQ(dut.fd(), -1);
  }
  dup2(before, STDIN_FILENO);
  close(nothing);
  close(before);
}

TEST(StatusLine, IntoAFileNothingIsWritten) {
  testing::internal::CaptureStderr();
  {
    StatusLine dut;
    EXPECT_FALSE(dut.is_terminal());
    dut.Show("1.00 of 2.00 s");
    dut.Wipe();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace priamos::cli
