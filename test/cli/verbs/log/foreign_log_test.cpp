#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/schema.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

// Logs of somebody else's robot: other types, some of them on channels that are named as ours are.

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kTypes = R"(package theirs;
struct point_t { double xyz[3]; }
struct scan_t { const int32_t SIDES = 2; int64_t when; int32_t n; point_t points[n]; string names[SIDES]; }
struct blob_t { int32_t size; byte data[size]; boolean last; }
struct beat_t {
  int64_t when; // [us] @age 10000000 @step 100: of the beat
  int32_t count; // [-] @range 0,1000: how many
}
)";

class ForeignLog : public testing::Test {
 protected:
  ForeignLog() {
    std::ofstream(folder_ / "theirs.lcm") << kTypes;
    std::ofstream(folder_ / "broken.lcm") << "package theirs;\nstruct broken_t { nobody.knows_t x; }\n";
    MessageLog log(log_);
    for (int i = 0; i < 6; ++i) AddRound(log, i);
  }
  std::vector<std::byte> Encoded(const char* type, const bus::Json& message) const {
    return bus::FromJson(*types_.Find(std::string_view(type)), message);
  }
  void AddRound(MessageLog& log, int i) const {
    const bus::Json point{{"xyz", {0.5, i, -1.0}}};
    log.AddBytes(i, "lidar/front left",
                 Encoded("scan_t", {{"when", i}, {"points", {point, point}}, {"names", {"a", ""}}}));
    log.AddBytes(i + 0.1, "CLAIM", Encoded("blob_t", {{"data", "AAEC/w=="}, {"last", true}}));
    log.AddBytes(i + 0.2, "HEALTH", Encoded("beat_t", {{"when", i}, {"count", i}}));
    log.AddBytes(i + 0.3, "RAW", std::vector<std::byte>(static_cast<std::size_t>(i), std::byte{1}));
  }
  static void ExpectSameMessages(const std::vector<bus::LogEvent>& dut,
                                 const std::vector<bus::LogEvent>& events) {
    ASSERT_EQ(dut.size(), events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(dut[i].channel, events[i].channel) << i;
      EXPECT_EQ(dut[i].bytes, events[i].bytes) << i;
    }
  }

  TemporaryFolder folder_;
  bus::Schema types_{{{"theirs.lcm", kTypes}}};
  std::string log_ = folder_ / "their.lcmlog", out_ = folder_ / "out.lcmlog";
};

TEST_F(ForeignLog, IsDecodedThoughOneTypeIsBroken) {
  const auto answer = Priamos({"log", "info", log_, "--json", "--types", folder_.path()});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.err,
              HasSubstr("broken.lcm:2: theirs.broken_t.x: expected a type that is defined, got nobody"));
  const auto dut = json::parse(answer.out);
  EXPECT_EQ(dut.at("undecodable"), 6) << "RAW";
  EXPECT_EQ(dut.at("channels").at(0).at("types"), json::array({"theirs.blob_t"}));
}

TEST_F(ForeignLog, WhyNothingCouldBeDecodedIsSaid) {
  const auto err = [&](const std::string& channel, bool types) {
    std::vector<std::string> words{"log", "export", log_, "jsonl", "--channels", channel};
    if (types) words.insert(words.end(), {"--types", folder_.path()});
    const auto answer = Priamos(words);
    EXPECT_EQ(answer.exit_code, 1) << channel;
    return answer.err;
  };
  EXPECT_THAT(err("CLAIM", false), HasSubstr("name its .lcm folder with --types"));
  EXPECT_THAT(err("RAW", true), HasSubstr("expected a type that --types or the log defines, got RAW with "
                                          "fingerprint none"));
  auto damaged = Encoded("blob_t", {{"data", "AAEC/w=="}, {"last", true}});
  damaged[8] = std::byte{0xff};  // the count
  MessageLog(log_).AddBytes(0, "BLOB", damaged);
  const std::string all_damaged = err("BLOB", true);
  EXPECT_THAT(all_damaged,
              HasSubstr("all messages are damaged: first BLOB of theirs.blob_t, byte 8 of 17: the "
                        "count of an array is negative"));
  EXPECT_THAT(all_damaged, testing::Not(HasSubstr("--types")));
}

TEST_F(ForeignLog, RepairKeepsWhatIsNotDamaged) {
  const auto events = EventsOf(log_);
  std::string bytes = FileContent(log_);
  for (std::size_t damaged = 0; damaged < events.size(); ++damaged) {
    std::string wrong = bytes;
    wrong.replace(events[damaged].offset, 28, 28, '?');
    const std::string file = folder_ / "damaged.lcmlog";
    std::ofstream(file, std::ios::binary) << wrong;
    ASSERT_EQ(Priamos({"log", "repair", file, out_, "--force"}).exit_code, 0);
    auto whole = events;
    whole.erase(whole.begin() + static_cast<std::ptrdiff_t>(damaged));
    ExpectSameMessages(EventsOf(out_), whole);
  }
}

TEST_F(ForeignLog, IsPlayedWholeAlsoOnChannelsNamedAsOurs) {
  const auto answer = Priamos({"log", "play", log_, "--speed", "max", "--bus", SinkUrl(out_), "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(json::parse(answer.out).at("sent"), 24);
  ExpectSameMessages(EventsOf(out_), EventsOf(log_));
}

TEST_F(ForeignLog, IsRecordedByteForByte) {
  const std::string url = "file://" + log_ + "?speed=0";
  EXPECT_EQ(Priamos({"log", "record", out_, "--seconds", "0.05", "--no-health", "--bus", url}).exit_code, 0);
  ExpectSameMessages(EventsOf(out_), EventsOf(log_));
}

TEST_F(ForeignLog, IsMergedWithAnOffset) {
  const std::string second = folder_ / "second.lcmlog";
  MessageLog other(second);
  AddRound(other, 3);
  EXPECT_EQ(Priamos({"log", "merge", log_, second, out_, "--offset", "-10", "--prefix", "B "}).exit_code, 0);
  const auto merged = EventsOf(out_);
  ASSERT_EQ(merged.size(), 28u);
  EXPECT_EQ(merged[0].channel, "B lidar/front left");
  EXPECT_EQ(merged[0].utime, MessageLog::UtimeAt(-7));
  ExpectSameMessages({merged.begin() + 4, merged.end()}, EventsOf(log_));
}

TEST_F(ForeignLog, IsMergedByItsOwnStampsWhenItsTypesAreAnnotated) {
  const std::string second = folder_ / "second.lcmlog";
  MessageLog here(log_), there(second);
  for (int i = 0; i < 20; ++i) {
    const auto at = MessageLog::UtimeAt(i);
    here.AddBytes(i + 0.01, "BEAT", Encoded("beat_t", {{"when", at}, {"count", i}}));
    there.AddBytes(i + 5.2, "BEAT", Encoded("beat_t", {{"when", at + 5'000'000}, {"count", i}}));
  }
  const auto answer = Priamos({"log", "merge", log_, second, out_, "--types", folder_.path(), "--json"});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(json::parse(answer.out).at("messages_in_both"), 20);
  EXPECT_NEAR(json::parse(answer.out).at("offset_s").get<double>(), -5, 0.01);
  EXPECT_EQ(Priamos({"log", "merge", log_, second, out_, "--force"}).exit_code, 2) << "types unknown";
}

TEST_F(ForeignLog, MergeRefusesANameThatNoLogCanHold) {
  const std::string second = folder_ / "second.lcmlog";
  MessageLog(second).AddBytes(0, std::string(250, 'c'), {});
  const auto answer = Priamos({"log", "merge", log_, second, out_, "--offset", "0"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err,
              HasSubstr("expected a name of 1 to 255 printable ASCII characters, got one of 259"));
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(Priamos({"log", "merge", log_, second, out_, "--offset", "0", "--prefix", "B"}).exit_code, 0);
}

}  // namespace
}  // namespace priamos::cli
