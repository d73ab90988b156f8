#include "bus/wire/udp_receiver.hpp"

#include <gtest/gtest.h>

#include "bus/wire/bus_error.hpp"

// With a network: test/system/bus_tools_test.cpp.

namespace priamos::bus {
namespace {

TEST(UdpReceiver, AnAddressThatIsNoneIsASentence) {
  EXPECT_THROW(UdpReceiver("udpm://nonsense:7667"), BusError);
}

TEST(SenderAddress, WhoHasNoAddressIsOnThisMachine) {
  constexpr std::uint64_t kPort = 0x3930;  // 12345, in network order on a machine of ours
  EXPECT_EQ(SenderAddress(std::uint64_t{0x0100007f} << 16 | kPort), "127.0.0.1:12345");
  EXPECT_EQ(SenderAddress(kPort), "localhost:12345");
}

}  // namespace
}  // namespace priamos::bus
