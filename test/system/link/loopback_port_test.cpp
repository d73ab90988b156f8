// A link whose key everybody knows is for nobody but this machine: what the kernel says of its sockets.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One end for each way to listen, on a machine that has another address than loopback; then their sockets,
/// and what ends say that were told to listen there.
constexpr const char* kScript = R"sh(
  cd {}
  ip address add 10.9.9.9/24 dev lo
  channel='[[channel]]\nname = "POSE"\ntype = "pose_t"\ndirection = "up"\nclass = "state"\n'
  printf "simulation_key = true\n$channel" > stream.toml
  printf "simulation_key = true\ndatagrams = true\nbaud = 115200\n$channel" > datagrams.toml
  radio() {{ exec timeout 20 $BIN/priamos-radio --bus onboard --robot $1 --set link=$2.toml --set port=$3 --config side.toml; }}
  echo 'side = "onboard"' > side.toml
  ends=1
  radio a stream tcp::7300 & radio b datagrams udp:127.0.0.1:7401@7402 &
  if [ -s /proc/net/if_inet6 ]; then echo has IPv6; ends=2; radio c datagrams udp:[::1]:7401@7403 & fi
  for i in $(seq 100); do
    [ "$(ss -Haun | grep -o ':740[23] ' | sort -u | wc -l)" = $ends ] && ss -Hltn | grep -q ':7300 ' && break
    sleep 0.05
  done
  echo sockets:
  ss -Haltun | grep -o '[^ ]*:7[34]0[023] ' | sort -u
  kill $(jobs -p); wait
  for port in tcp:0.0.0.0:7300 tcp:10.9.9.9:7300 tcp:[::]:7300; do (radio d stream $port); done
  for port in udp:0.0.0.0:7401 udp:10.9.9.9:7401 udp:[::]:7401; do (radio d datagrams $port); done
)sh";

TEST(LoopbackPort, AKeyThatEverybodyKnowsIsHeardByThisMachineAlone) {
  const TemporaryFolder folder;
  const std::string text =
      RunInPrivateNetwork(fmt::format(kScript, folder.path().string()), folder / "script.sh", 60).text;
  const std::string sockets = text.substr(std::min(text.find("sockets:"), text.size()));
  for (const char* socket : {"\n127.0.0.1:7300 ", "\n127.0.0.1:7402 "})
    EXPECT_THAT(sockets, HasSubstr(socket)) << text;
  if (text.find("has IPv6") != text.npos) {
    EXPECT_THAT(sockets, HasSubstr("\n[::1]:7403 ")) << text;
  }
  for (const char* open : {"0.0.0.0:7", "*:7", "[::]:7300 \n", "10.9.9.9:7300 \n"})
    EXPECT_THAT(sockets.substr(0, sockets.find("priamos-radio")), Not(HasSubstr(open))) << text;
  std::size_t refusals = 0;
  for (std::size_t at = 0; (at = sockets.find("simulation_key: expected false on", at)) != sockets.npos; ++at)
    ++refusals;
  EXPECT_EQ(refusals, 6U) << text;
}

}  // namespace
}  // namespace priamos
