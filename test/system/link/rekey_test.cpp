// The recipe of modules/radio/README.md for a new key, with the real programs, while commands and requests
// cross.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

#include "bus/log/log_reader.hpp"
#include "bus/node.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

constexpr int kCommands = 280;             ///< in 14 s
constexpr int kRequests = kCommands / 40;  ///< one in 2 s, as many as link.toml allows
/// A restart of the offboard process takes about half a second, in which it hears nothing of its bus.
constexpr int kUnheard = 2;

struct Heard {
  std::vector<int> requests, commands;
};
Heard HeardIn(const std::string& path) {
  Heard heard;
  bus::LogReader log(path);
  while (const auto event = log.Next()) {
    if (event->channel == channels::kLookRequest.name)
      heard.requests.push_back(bus::Decode<look_request_t>(event->bytes).request_id);
    if (event->channel == channels::kDriveCommand.name)
      heard.commands.push_back(bus::Decode<drive_command_t>(event->bytes).sequence);
  }
  return heard;
}

std::string ContentOf(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Rekey, TheRecipeChangesTheKeyOfTwoProcessesWhileTheyWork) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork(fmt::format(R"sh(
    cd {}
    for side in onboard offboard; do
      mkdir $side
      grep -v simulation_key $SOURCE/config/sim/link.toml > $side/link.toml
      printf 'link = "link.toml"\nstate_file = "state"\n' > $side/radio.toml
    done
    $BIN/priamos link keygen onboard/link.key; cp -p onboard/link.key offboard/
    $BIN/priamos link emulate --a tty-a --b tty-b > emulate.txt & EMULATE=$!
    until [ -e tty-b ]; do sleep 0.05; done
    radio() {{ exec $BIN/priamos-radio --config $1/radio.toml --set side=$1 --set port=$2 --bus $1 >> $1.txt 2>&1; }}
    radio onboard tty-a & ONBOARD=$!
    radio offboard tty-b & OFFBOARD=$!
    $BIN/priamos log record heard.lcmlog --bus onboard > record.txt 2>&1 & RECORDER=$!
    sleep 1
    python3 $SOURCE/test/support/drive_commands.py {} --requests & SENDER=$!
    sleep 2
    $BIN/priamos link rekey onboard/link.key && cp -p onboard/link.key.next offboard/
    kill $ONBOARD; wait $ONBOARD; radio onboard tty-a & ONBOARD=$!
    sleep 3
    kill $OFFBOARD; wait $OFFBOARD; radio offboard tty-b & OFFBOARD=$!
    sleep 3
    for side in onboard offboard; do $BIN/priamos link rekey --finish $side/link.key; done
    kill $ONBOARD; wait $ONBOARD; radio onboard tty-a & ONBOARD=$!
    wait $SENDER; sleep 2
    kill -INT $RECORDER; wait $RECORDER
    kill $ONBOARD $OFFBOARD $EMULATE; wait
    cmp onboard/link.key offboard/link.key && ls onboard/link.key.next
  )sh",
                                                      folder.path().string(), kCommands),
                                          folder / "script.sh", 60);
  for (const char* side : {"onboard.txt", "offboard.txt"})
    EXPECT_THAT(ContentOf(folder / side), HasSubstr("the link uses the next key")) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("cannot access 'onboard/link.key.next'"));
  const Heard heard = HeardIn(folder / "heard.lcmlog");
  EXPECT_GE(heard.requests.size(), static_cast<std::size_t>(kRequests - kUnheard)) << answer.text;
  EXPECT_EQ(std::adjacent_find(heard.requests.begin(), heard.requests.end(), std::greater_equal<>()),
            heard.requests.end())
      << testing::PrintToString(heard.requests);
  EXPECT_GE(heard.commands.size(), 150U) << "of 280, of which three restarts of a process took some";
}

}  // namespace
}  // namespace priamos
