#include "radio/link_health.hpp"

#include <gmock/gmock.h>

namespace priamos::radio {
namespace {

using testing::HasSubstr;

link_status_t Up() {
  link_status_t status{};
  status.up = true;
  return status;
}

TEST(LinkHealth, ALinkThatIsUpIsWell) {
  const LinkHealth dut = HealthOf(Up(), 8, 8);
  EXPECT_EQ(dut.health, bus::Health::kOk);
  EXPECT_EQ(dut.why, "");
}

TEST(LinkHealth, SilenceAndForgeriesDegradeIt) {
  EXPECT_EQ(HealthOf(link_status_t{}, 8, 8).health, bus::Health::kDegraded);
  EXPECT_THAT(HealthOf(link_status_t{}, 8, 8).why, HasSubstr("nothing is heard"));
  link_status_t forged = Up();
  forged.alarm = true;
  EXPECT_EQ(HealthOf(forged, 8, 8).health, bus::Health::kDegraded);
  EXPECT_THAT(HealthOf(forged, 8, 8).why, HasSubstr("did not send"));
}

TEST(LinkHealth, AnotherTableIsAFailureThatNamesItsMendBeforeAllElse) {
  link_status_t other{};
  other.table_mismatch = other.alarm = true;
  EXPECT_EQ(HealthOf(other, 8, 8).health, bus::Health::kFailed);
  EXPECT_THAT(HealthOf(other, 8, 8).why, HasSubstr("compare link.toml and lcmtypes"));
  EXPECT_EQ(HealthOf(other, 8, 4).health, bus::Health::kFailed);
  EXPECT_THAT(HealthOf(other, 8, 4).why, HasSubstr("codes of 4 bytes, this one of 8: set code_bytes"));
}

}  // namespace
}  // namespace priamos::radio
