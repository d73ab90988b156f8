#include "bus/wire/multicast.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

TEST(GroupOf, ReadsTheGroupOfAnLcmUrl) {
  EXPECT_EQ(GroupOf("udpm://239.1.1.1:7700?ttl=0"), "239.1.1.1");
  EXPECT_EQ(GroupOf("udpm://239.1.1.1?ttl=0"), "239.1.1.1");
  EXPECT_EQ(GroupOf("udpm://"), "239.255.76.67");
  EXPECT_EQ(GroupOf("udpm://?ttl=1:2"), "239.255.76.67");
}

TEST(PortOf, ReadsThePortOfAnLcmUrl) {
  EXPECT_EQ(PortOf("udpm://239.255.76.67:7700?ttl=0"), 7700);
  EXPECT_EQ(PortOf("udpm://239.255.76.67:7701"), 7701);
  EXPECT_EQ(PortOf("udpm://"), 7667);
  EXPECT_EQ(PortOf("udpm://239.255.76.67?ttl=1"), 7667);
  EXPECT_EQ(PortOf("udpm://239.255.76.67?ttl=1:2"), 7667);
  EXPECT_EQ(PortOf("udpm://239.255.76.67:7702x"), 7702) << "as liblcm reads it";
}

}  // namespace
}  // namespace priamos::bus
