#include "bus/wire/network_interface.hpp"

#include <gmock/gmock.h>

#include "bus/wire/bus_error.hpp"
#include "test/support/thrown_reason.hpp"

// With several interfaces: test/system/hosts/hosts_test.cpp.

namespace priamos::bus {
namespace {

using support::ThrownReason;
using testing::Contains;
using testing::HasSubstr;

TEST(FindInterface, KnowsLoopbackByNameAndByAddress) {
  const NetworkInterface lo = FindInterface("lo");
  EXPECT_TRUE(lo.loopback);
  EXPECT_NE(lo.index, 0U);
  EXPECT_THAT(lo.addresses, Contains("127.0.0.1"));
  EXPECT_EQ(FindInterface("127.0.0.1").name, "lo");
}

TEST(FindInterface, AnUnknownOneIsAnsweredWithThoseThereAre) {
  const std::string reason = ThrownReason([] { FindInterface("l0"); });
  EXPECT_THAT(reason, HasSubstr("lo (127.0.0.1"));
  EXPECT_THAT(reason, HasSubstr("got \"l0\""));
  EXPECT_THROW(FindInterface(""), BusError);
  EXPECT_THROW(FindInterface("127.0.0.1 "), BusError);
}

TEST(InterfaceOfRoute, IsTheOneThatTheKernelTakes) {
  EXPECT_EQ(InterfaceOfRoute("127.0.0.1"), "lo");
  EXPECT_EQ(InterfaceOfRoute("nonsense"), "");
}

}  // namespace
}  // namespace priamos::bus
