#include "bus/wire/multicast.hpp"

#include <gmock/gmock.h>

#include "bus/wire/bus_error.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::bus {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

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

TEST(TtlOf, IsZeroUnlessTheUrlSaysMore) {
  EXPECT_EQ(TtlOf("udpm://239.1.1.1:7700"), 0);
  EXPECT_EQ(TtlOf("udpm://239.1.1.1:7700?network=eth1&ttl=3"), 3);
  EXPECT_EQ(TtlOf("udpm://239.1.1.1:7700?ttl=255"), 255);
  for (const char* wrong : {"256", "-1", "1x", "1:2", " 1"})
    EXPECT_THROW(TtlOf(std::string("udpm://239.1.1.1:7700?ttl=") + wrong), BusError) << wrong;
}

TEST(NetworkOf, IsNamedByTheUrlOrByNobody) {
  EXPECT_EQ(NetworkOf("udpm://239.1.1.1:7700?ttl=1&network=eth1"), "eth1");
  EXPECT_EQ(NetworkOf("udpm://239.1.1.1:7700?network=10.77.0.1"), "10.77.0.1");
  EXPECT_EQ(NetworkOf("udpm://239.1.1.1:7700?ttl=1"), "");
  EXPECT_EQ(NetworkOf("udpm://"), "");
}

TEST(WithNetwork, IsAddedOnceAndOnlyWhereItMeansSomething) {
  EXPECT_EQ(WithNetwork("udpm://239.1.1.1:7700?ttl=1", "eth1"), "udpm://239.1.1.1:7700?ttl=1&network=eth1");
  EXPECT_EQ(WithNetwork("udpm://239.1.1.1:7700", "eth1"), "udpm://239.1.1.1:7700?network=eth1");
  EXPECT_EQ(WithNetwork("udpm://239.1.1.1:7700?network=eth0", "eth1"), "udpm://239.1.1.1:7700?network=eth0");
  EXPECT_EQ(WithNetwork("udpm://239.1.1.1:7700", ""), "udpm://239.1.1.1:7700");
  EXPECT_EQ(WithNetwork("memq://", "eth1"), "memq://");
}

TEST(WithoutNetwork, LeavesWhatLcmsOwnProgramsKnow) {
  EXPECT_EQ(WithoutNetwork("udpm://239.1.1.1:7700?ttl=1&network=eth1"), "udpm://239.1.1.1:7700?ttl=1");
  EXPECT_EQ(WithoutNetwork("udpm://239.1.1.1:7700?network=eth1&ttl=1&recv_buf_size=9"),
            "udpm://239.1.1.1:7700?ttl=1&recv_buf_size=9");
  EXPECT_EQ(WithoutNetwork("udpm://239.1.1.1:7700?network=eth1"), "udpm://239.1.1.1:7700");
}

TEST(RequireMulticastUrl, RefusesWhatIsNone) {
  EXPECT_NO_THROW(RequireMulticastUrl("udpm://239.1.1.1:7700?ttl=1&network=eth1&recv_buf_size=100000"));
  EXPECT_THAT(ThrownReason([] { RequireMulticastUrl("udpm://10.0.0.1:7700"); }),
              HasSubstr("expected a multicast address"));
  EXPECT_THAT(ThrownReason([] { RequireMulticastUrl("udpm://239.1.1.1:7700?netwrok=eth1"); }),
              HasSubstr("got \"netwrok\"; nearest: \"network\""));
  EXPECT_THROW(RequireMulticastUrl("udpm://239.1.1.1:7700?ttl=999"), BusError);
}

TEST(RequireMulticastRoute, ANetworkThatIsNotHereIsAnsweredWithThoseThatAre) {
  EXPECT_THAT(ThrownReason([] { RequireMulticastRoute("udpm://239.1.1.1:7700?network=eth77"); }),
              HasSubstr("lo (127.0.0.1"));
  EXPECT_NO_THROW(RequireMulticastRoute("udpm://239.1.1.1:7700?network=lo"));
}

}  // namespace
}  // namespace priamos::bus
