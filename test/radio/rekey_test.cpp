#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "radio/key_file.hpp"
#include "radio/radio_app.hpp"
#include "test/support/temporary_folder.hpp"

// The recipe of the README for a new key, with the files of both processes.

namespace priamos::radio {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kLink = R"(
key_file = "link.key"
[[channel]]
name = "LOOK_REQUEST"
type = "look_request_t"
direction = "down"
class = "event"
rate_hz = 2
)";

/// Two machines: for each a folder with link.toml, key and memory.
struct RadioRekey : testing::Test {
  RadioRekey() {
    for (const std::string side : {"onboard", "offboard"}) {
      std::filesystem::create_directories(folder / side);
      std::ofstream(folder / side / "link.toml") << kLink;
      std::ofstream(folder / side / "radio.toml") << "link = \"link.toml\"\nstate_file = \"state\"\n";
    }
    WriteNewKeyFile(Key("onboard"));
    Copy(Key("onboard"), Key("offboard"));
  }
  std::string Key(const std::string& side) const { return (folder / side / "link.key").string(); }
  static void Copy(const std::string& from, const std::string& to) {
    std::filesystem::copy_file(from, to);
    std::filesystem::permissions(to,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  }
  /// Both processes from start to end, in order, while the offboard end sends some requests. Returns those
  /// that arrive.
  std::vector<int> RunBoth(int requests) {
    log.clear();
    bus::Lockstep lockstep(schema, {.seed = ++runs_,
                                    .start = FromUtime(1'000'000'000'000 * static_cast<std::int64_t>(runs_)),
                                    .log = [this](auto, auto, auto, auto text) { log.emplace_back(text); }});
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(bus::FactoryOf<RadioApp>(), side,
                      {(folder / side / "radio.toml").string(), {"side=" + side, "port=tty-" + side}});
    auto look = lockstep.DriverNode("offboard").Advertise(channels::kLookRequest);
    auto looks = lockstep.DriverNode("onboard").SubscribeAll(channels::kLookRequest);
    for (int i = 0; i < requests; ++i) {
      look_request_t request{};
      request.utime = ToUtime(lockstep.now());
      request.request_id = ++sent_;
      look.Publish(request);
      lockstep.RunUntil(lockstep.now() + FromSeconds(2));
    }
    std::vector<int> ids;
    for (const look_request_t& request : looks.Drain()) ids.push_back(request.request_id);
    return ids;
  }

  TemporaryFolder folder;
  std::vector<std::string> log;
  bus::Schema schema = bus::OwnTypes();

 private:
  std::uint64_t runs_ = 0;
  int sent_ = 0;
};

TEST_F(RadioRekey, TheRecipeChangesTheKeyAndEveryRequestArrivesOnce) {
  EXPECT_THAT(RunBoth(2), ElementsAre(1, 2));
  WriteNextKeyFile(Key("onboard"));
  EXPECT_THAT(RunBoth(2), ElementsAre(3, 4));
  EXPECT_THAT(log, Contains(HasSubstr("changes to it when the other end has it")).Times(1));
  EXPECT_THAT(log, Contains(HasSubstr("the other end has a next key")).Times(1));
  Copy(NextKeyFile(Key("onboard")), NextKeyFile(Key("offboard")));
  EXPECT_THAT(RunBoth(2), ElementsAre(5, 6));
  EXPECT_THAT(log, Contains(HasSubstr("the link uses the next key")).Times(2));
  FinishKeyChange(Key("onboard"));
  EXPECT_THAT(RunBoth(2), ElementsAre(7, 8));
  FinishKeyChange(Key("offboard"));
  EXPECT_THAT(RunBoth(2), ElementsAre(9, 10));
  EXPECT_THAT(log, Not(Contains(HasSubstr("next key"))));
}

TEST_F(RadioRekey, DifferentNextKeysAreNamedOnceAtEachEnd) {
  for (const std::string side : {"onboard", "offboard"}) WriteNextKeyFile(Key(side));
  EXPECT_THAT(RunBoth(4), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(log, Contains(HasSubstr("the other end has another next key")).Times(2));
}

TEST_F(RadioRekey, ANextKeyThatIsWrongIsNamedAndTheLinkGoesOnUnderItsKey) {
  std::ofstream(NextKeyFile(Key("onboard"))) << "cut o";
  std::filesystem::permissions(NextKeyFile(Key("onboard")),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_THAT(RunBoth(2), ElementsAre(1, 2));
  EXPECT_THAT(log, Contains(AllOf(HasSubstr("link.key.next: expected 64 hexadecimal digits"),
                                  HasSubstr("the link goes on under its key"))));
  Copy(Key("offboard"), NextKeyFile(Key("offboard")));  // the same key
  EXPECT_THAT(RunBoth(1), ElementsAre(3));
  EXPECT_THAT(log, Contains(HasSubstr("expected another key than")));
}

}  // namespace
}  // namespace priamos::radio
