#include "bus/wire/udp_receiver.hpp"

#include <gtest/gtest.h>

#include "bus/wire/bus_error.hpp"

// With a network: test/system/bus_tools_test.cpp.

namespace priamos::bus {
namespace {

TEST(UdpReceiver, AnAddressThatIsNoneIsASentence) {
  EXPECT_THROW(UdpReceiver("udpm://nonsense:7667"), BusError);
}

}  // namespace
}  // namespace priamos::bus
