#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <thread>

// Cases that end in every way in which a case can end, for the test of run_cases.py.

namespace {

bool bad_end = false;

/// Ends the process badly after its last case, as a leak that a sanitizer finds there.
struct AtExit {
  ~AtExit() {
    if (bad_end) _exit(23);
  }
} at_exit;

TEST(Good, Passes) {}
TEST(Good, PassesBehindATextWithoutEnd) {
  std::cout << "no end of line " << std::flush;
}
TEST(Good, IsSkipped) {
  GTEST_SKIP() << "not today";
}
TEST(Good, DISABLED_NeverRuns) {
  FAIL();
}

TEST(Bad, Fails) {
  std::cout << "what it said\n";
  EXPECT_EQ(1, 2);
}
TEST(Bad, Dies) {
  std::cout << "its last words " << std::flush;
  std::raise(SIGSEGV);
}
TEST(Bad, EndsTheProgram) {
  _exit(0);
}
TEST(Bad, Hangs) {
  std::this_thread::sleep_for(std::chrono::hours(1));
}
TEST(Bad, EndsBadlyAfterAll) {
  bad_end = true;
}

/// Fails only behind another case: what it finds was left there.
int left_behind = 0;
TEST(Together, LeavesSomething) {
  ++left_behind;
}
TEST(Together, FindsNothing) {
  EXPECT_EQ(left_behind, 0);
}

class ByNumber : public ::testing::TestWithParam<int> {};
TEST_P(ByNumber, IsSmall) {
  EXPECT_LT(GetParam(), 3);
}
INSTANTIATE_TEST_SUITE_P(All, ByNumber, ::testing::Values(1, 2));

}  // namespace
