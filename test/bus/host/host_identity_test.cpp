#include "bus/host/host_identity.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

TEST(ThisHost, IsTheSameWheneverItIsAsked) {
  const HostIdentity first = ThisHost(), second = ThisHost();
  EXPECT_EQ(first.id, second.id);
  EXPECT_EQ(first.boot, second.boot);
  EXPECT_EQ(first.name, second.name);
  EXPECT_FALSE(first.name.empty());
  EXPECT_EQ(first.boot.size(), 36U) << "a UUID of the kernel: " << first.boot;
}

}  // namespace
}  // namespace priamos::bus
