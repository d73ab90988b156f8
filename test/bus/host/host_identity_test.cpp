#include "bus/host/host_identity.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

TEST(ThisHost, IsTheSameWheneverItIsAsked) {
  const HostIdentity first = ThisHost(), second = ThisHost();
  EXPECT_EQ(first.IdAt("10.77.0.1"), second.IdAt("10.77.0.1"));
  EXPECT_EQ(first.boot, second.boot);
  EXPECT_EQ(first.name, second.name);
  EXPECT_FALSE(first.name.empty());
  EXPECT_EQ(first.boot.size(), 36U) << "a UUID of the kernel: " << first.boot;
}

/// A virtual machine that is copied while it runs shares boot and network namespace with its copy.
TEST(ThisHost, IsAnotherOneAtAnotherAddress) {
  const HostIdentity host = ThisHost();
  EXPECT_NE(host.IdAt("10.77.0.1"), host.IdAt("10.77.0.2"));
}

}  // namespace
}  // namespace priamos::bus
