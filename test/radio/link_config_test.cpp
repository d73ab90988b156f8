#include "bus/radio/link_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "bus/own_types.hpp"
#include "bus/radio/budget.hpp"
#include "lcmtypes/channels.hpp"

// The shipped link against the channels of the robot.

namespace priamos::radio {
namespace {

using bus::radio::LinkConfig;

LinkConfig Shipped() {
  return LoadConfig<LinkConfig>(std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/link.toml");
}

TEST(ShippedLink, ChannelsAreThoseOfTheRobotWithTheirTypes) {
  for (const auto& channel : Shipped().channels) {
    bool found = false;
    std::apply(
        [&](const auto&... c) {
          ((found = found || (c.name == channel.name &&
                              std::decay_t<decltype(c)>::Message::getTypeName() == channel.type)),
           ...);
        },
        channels::kAll);
    EXPECT_TRUE(found) << channel.name << " " << channel.type;
  }
}

TEST(ShippedLink, BudgetHolds) {
  const bus::Schema schema = bus::OwnTypes();
  const auto budget = ComputeBudget(Shipped().Table(schema), Shipped().Options());
  EXPECT_THAT(budget.problems, testing::IsEmpty());
  EXPECT_LT(budget.up.utilisation, 0.5);
  EXPECT_LT(budget.down.utilisation, 0.5);
}

}  // namespace
}  // namespace priamos::radio
