#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "test/system/link/link_script.hpp"

// Emergency stops over TCP, where what is repeated or answered goes in blocks as on a serial line.

namespace priamos {
namespace {

constexpr const char* kStops = R"(
L=config/sim/link.toml
stop() { priamos topic pub ESTOP estop_t '{"utime":1,"action":1,"driver":2}' --bus offboard >/dev/null; }
priamos-radio --config $L --offboard --port tcp:127.0.0.1:5999 --bus offboard & sleep 0.5
stop  # before there is a connection
priamos topic echo ESTOP --bus onboard --json --count 3 & e=$!
sleep 0.5
priamos-radio --config $L --onboard --port tcp::5999 --bus onboard & sleep 3
stop; sleep 0.5; stop
for i in $(seq 50); do kill -0 $e 2>/dev/null || break; sleep 0.1; done
)";

TEST(TcpStop, OneThatWaitedForTheConnectionHoldsNoLaterOneBack) {
  const std::string text = RunInPrivateNetwork(kStops, 60);
  const std::regex stop(R"re("driver":2)re");
  EXPECT_EQ(std::distance(std::sregex_iterator(text.begin(), text.end(), stop), {}), 3) << text;
}

}  // namespace
}  // namespace priamos
