#include "bus/wire/bus_address.hpp"

#include <gtest/gtest.h>

#include <set>

#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/multicast.hpp"

namespace priamos::bus {
namespace {

TEST(BusAddress, GroupAndPortFollowFromTheNameAndAreTheSameOnEveryMachine) {
  EXPECT_EQ(BusUrl("priamos", BusSide::kOnboard, 0), "udpm://239.255.234.67:21932?ttl=0");
  EXPECT_EQ(BusUrl("priamos", BusSide::kOffboard, 1), "udpm://239.255.234.68:21933?ttl=1");
}

TEST(BusAddress, LcmsDefaultIsNobodys) {
  std::set<std::string> groups;
  for (int i = 0; i < 20000; ++i) {
    const std::string url =
        BusUrl("r" + std::to_string(i), i % 2 ? BusSide::kOnboard : BusSide::kOffboard, 1);
    ASSERT_NE(PortOf(url), kLcmDefaultPort) << url;
    groups.insert(GroupOf(url));
  }
  EXPECT_EQ(groups.size(), 2U * 254U);
}

/// A name leads to one of 1.5 million addresses: a fleet of 100 has two of one address once in 300 fleets.
TEST(BusAddress, NamesRarelyLeadToOneAddress) {
  std::set<std::string> urls;
  for (int i = 0; i < 1000; ++i) urls.insert(BusUrl("robot-" + std::to_string(i), BusSide::kOnboard, 0));
  EXPECT_GE(urls.size(), 998U);
}

TEST(BusAddress, RobotsAndSidesDifferInTheirPort) {
  std::set<int> ports;
  for (const auto* robot : {"priamos", "hektor", "kassandra", "robot-1", "robot-2"})
    for (const auto side : {BusSide::kOnboard, BusSide::kOffboard})
      ports.insert(PortOf(BusUrl(robot, side, 0)));
  EXPECT_EQ(ports.size(), 10U);
  EXPECT_GT(*ports.begin(), 19999);
  EXPECT_LT(*ports.rbegin(), 32768);
}

TEST(BusAddress, ANameThatIsNoneIsRefused) {
  for (const auto* name : {"", "Priamos", "a b", "a/b", "a123456789012345678901234567890123"})
    EXPECT_THROW(BusUrl(name, BusSide::kOnboard, 0), BusError) << name;
  EXPECT_THROW(BusUrl("priamos", BusSide::kOnboard, 256), BusError);
  EXPECT_THROW(BusUrl("priamos", BusSide::kOnboard, -1), BusError);
}

TEST(BusAddress, ABusIsNamedOrAUrl) {
  EXPECT_EQ(ResolveBus("onboard", "hektor", 1), BusUrl("hektor", BusSide::kOnboard, 1));
  EXPECT_EQ(ResolveBus("offboard", "hektor", 0), BusUrl("hektor", BusSide::kOffboard, 0));
  EXPECT_EQ(ResolveBus("memq://", "hektor", 0), "memq://");
  EXPECT_EQ(GroupOf(ResolveBus("udpm://239.1.1.1:1?ttl=3", "hektor", 0)), "239.1.1.1");
  EXPECT_THROW(ResolveBus("onbord", "hektor", 0), BusError);
}

}  // namespace
}  // namespace priamos::bus
