#include "common/rate_limit.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

TEST(RateLimit, TheFirstTimeIsDueAndTheNextAfterAPeriod) {
  RateLimit dut(5);
  EXPECT_TRUE(dut.Due(FromUtime(0)));
  EXPECT_TRUE(dut.Due(FromUtime(0))) << "it has not happened";
  dut.Mark(FromUtime(0));
  EXPECT_FALSE(dut.Due(FromUtime(199'990)));
  EXPECT_TRUE(dut.Due(FromUtime(200'000)));
}

TEST(RateLimit, APeriodThatIsNoWholeNumberOfMicrosecondsIsMet) {
  RateLimit dut(3);
  dut.Mark(FromUtime(0));
  EXPECT_TRUE(dut.Due(FromUtime(333'333)));
}

}  // namespace
}  // namespace priamos
