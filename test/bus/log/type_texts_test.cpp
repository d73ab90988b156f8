#include "bus/log/type_texts.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bus/log/log_export.hpp"
#include "bus/log/log_merge.hpp"
#include "bus/log/log_recorder.hpp"
#include "bus/log/log_survey.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "test/bus/schema/encoding.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A type as it was, and as it is today.
const Schema kThen =
    SchemaOf("package p; struct point_t { double x; } struct way_t { int8_t n; point_t at[n]; }");
const Schema kNow =
    SchemaOf("package p; struct point_t { double x, y; } struct way_t { int8_t n; point_t at[n]; }");

Bytes Way(const Schema& schema, const std::string& json) {
  return FromJson(*schema.Find("p.way_t"), Json::parse(json));
}
Bytes ThenWay() {
  return Way(kThen, R"({"at": [{"x": 1.5}]})");
}
Bytes NowWay() {
  return Way(kNow, R"({"at": [{"x": 2.5, "y": 3.5}]})");
}

class TypeTexts : public testing::Test {
 protected:
  std::string Write(const std::string& name, const Schema& schema, const Bytes& message) const {
    LogWriter log(folder_ / name);
    log.DefineTypesOf(schema);
    for (int i = 0; i < 3; ++i) log.Write(1000 + i, "WAY", message);
    return folder_ / name;
  }
  static std::vector<std::string> ChannelsOf(const std::string& log) {
    LogReader reader(log);
    std::vector<std::string> channels;
    while (const auto event = reader.Next()) channels.push_back(event->channel);
    return channels;
  }
  static std::string Lines(const std::string& log, const Schema& given) {
    LogReader reader(log);
    std::ostringstream out;
    ExportJsonLines(reader, given, {}, out);
    return out.str();
  }
  const TemporaryFolder folder_;
};

TEST_F(TypeTexts, TheTypeIsTheOneOfLcmtypes) {
  const auto texts =
      TypeScribe([](std::uint64_t fingerprint) { return kThen.Find(fingerprint); }).TextsBefore(ThenWay(), 7);
  ASSERT_EQ(texts.size(), 1u);
  const Schema own = OwnTypes();
  const Json message = ToJson(*own.Find("type_text_t"), texts[0]);
  EXPECT_EQ(message["utime"], 7);
  EXPECT_THAT(message["text"], HasSubstr("package p;\nstruct point_t {\n  double x;\n}\nstruct way_t {\n"));
}

TEST_F(TypeTexts, ALogDefinesATypeOnceBeforeItsFirstMessage) {
  EXPECT_THAT(ChannelsOf(Write("a", kThen, ThenWay())), ElementsAre("TYPE_TEXT", "WAY", "WAY", "WAY"));
  EXPECT_THAT(ChannelsOf(Write("b", kThen, NowWay())), ElementsAre("WAY", "WAY", "WAY"))
      << "of an unknown type";
}

TEST_F(TypeTexts, AnOldLogIsReadableWhenTheTypeHasChanged) {
  EXPECT_THAT(Lines(Write("a", kThen, ThenWay()), kNow),
              HasSubstr(R"("type":"p.way_t","message":{"n":1,"at":[{"x":1.5}]}})"));
  LogReader reader(folder_ / "a");
  EXPECT_EQ(Survey(reader, kNow).undecodable, 1u) << "nobody gave it type_text_t itself";
}

TEST_F(TypeTexts, LogsOfBothVersionsMergedAreReadable) {
  LogReader a(Write("a", kThen, ThenWay())), b(Write("b", kNow, NowWay()));
  {
    LogWriter log(folder_ / "both");
    EXPECT_EQ(MergeLogs(a, b, {}, "B_", log), 6u);
  }
  const std::string lines = Lines(folder_ / "both", SchemaOf(""));
  EXPECT_THAT(lines, HasSubstr(R"("at":[{"x":1.5}])"));
  EXPECT_THAT(lines,
              HasSubstr(R"("channel":"B_WAY","type":"p.way_t","message":{"n":1,"at":[{"x":2.5,"y":3.5}]})"));
}

TEST_F(TypeTexts, WhatIsCutOutOfALogTakesItsTypesAlong) {
  LogReader log(Write("a", kThen, ThenWay()));
  LogSelection selection;
  selection.only = {"WAY"};
  selection.from_utime = 1002;
  {
    LogWriter out(folder_ / "part");
    EXPECT_EQ(CopyEvents(log, selection, out), 1u);
  }
  EXPECT_THAT(ChannelsOf(folder_ / "part"), ElementsAre("TYPE_TEXT", "WAY"));
  EXPECT_THAT(Lines(folder_ / "part", kNow), HasSubstr(R"("x":1.5)"));
}

TEST_F(TypeTexts, EveryFileOfARecordingDefinesItsTypes) {
  {
    LogRecorder dut(folder_ / "day.lcmlog", {.split_bytes = 600}, FromUtime(0));
    dut.DefineTypesOf(kThen);
    for (int i = 0; i < 20; ++i) dut.Add(FromUtime(i), "WAY", ThenWay());
  }
  for (const std::string file : {"day.lcmlog", "day.1.lcmlog"}) {
    const auto channels = ChannelsOf(folder_ / file);
    EXPECT_EQ(channels.front(), "TYPE_TEXT") << file;
    EXPECT_EQ(std::count(channels.begin(), channels.end(), "TYPE_TEXT"), 1) << file;
  }
}

TEST_F(TypeTexts, ALongTextComesInPartsOfWholeCharacters) {
  std::string fields;
  for (int i = 0; i < 100; ++i)
    fields += "  double x" + std::to_string(i) + ";  // sch\u00f6n \u2014 " +
              std::string(static_cast<std::size_t>(i % 7), 'x') + "\n";
  const Schema schema = SchemaOf("struct big_t {\n" + fields + "}");
  const Bytes message = MessageBuilder(*schema.Find("big_t")).bytes();
  const auto texts =
      TypeScribe([&](std::uint64_t fingerprint) { return schema.Find(fingerprint); }).TextsBefore(message, 0);
  EXPECT_GE(texts.size(), 3u);
  LogTypes dut(nullptr);
  for (auto at = texts.rbegin(); at != texts.rend(); ++at) {
    EXPECT_LE(at->size(), 1400u) << "a player sends it as one datagram";
    EXPECT_EQ(dut.Of(message), nullptr);
    EXPECT_TRUE(ToJson(*OwnTypes().Find("type_text_t"), *at)["text"].is_string()) << "UTF-8";
    EXPECT_TRUE(dut.Take(*at)) << "in whatever order";
  }
  ASSERT_NE(dut.Of(message), nullptr);
  EXPECT_EQ(dut.Of(message)->fields.size(), 100u);
}

TEST_F(TypeTexts, TypesWhoseMessagesHoldBillionsOfEmptyStructsAreNotTaken) {
  const std::string wide = "struct e_t {} struct wide_t { e_t x[2000000000]; }";
  std::string deep = "struct c30_t {}";
  for (int i = 29; i >= 0; --i) deep += fmt::format("struct c{0}_t {{ c{1}_t a; c{1}_t b; }}", i, i + 1);
  const Schema own = OwnTypes(), types = SchemaOf(wide + deep);
  LogTypes dut(nullptr);
  dut.Take(FromJson(*own.Find("type_text_t"),
                    Json{{"utime", 0}, {"fingerprint", 1}, {"part", 0}, {"parts", 1}, {"text", wide}}));
  EXPECT_EQ(dut.Find(types.Find("wide_t")->fingerprint), nullptr);
  EXPECT_NE(dut.Find(types.Find("e_t")->fingerprint), nullptr);
  std::uint64_t parts = (deep.size() + 999) / 1000;
  for (std::uint64_t i = 0; i < parts; ++i)
    dut.Take(FromJson(*own.Find("type_text_t"), Json{{"utime", 0},
                                                     {"fingerprint", 2},
                                                     {"part", i},
                                                     {"parts", parts},
                                                     {"text", deep.substr(1000 * i, 1000)}}));
  EXPECT_EQ(dut.Find(types.Find("c0_t")->fingerprint), nullptr);
  EXPECT_NE(dut.Find(types.Find("c20_t")->fingerprint), nullptr);
}

TEST_F(TypeTexts, HostileTextsDoNoHarm) {
  const Schema own = OwnTypes();
  const auto text = [&](std::int64_t fingerprint, int part, int parts, const std::string& words) {
    return FromJson(
        *own.Find("type_text_t"),
        Json{{"utime", 0}, {"fingerprint", fingerprint}, {"part", part}, {"parts", parts}, {"text", words}});
  };
  LogTypes dut(nullptr);
  for (const auto& [part, parts] : {std::pair(0, 0), {-1, 1}, {5, 3}, {0, -2}, {0, 32767}})
    EXPECT_TRUE(dut.Take(text(parts, part, parts, "struct s { int8_t a; }")));
  for (const std::string words :
       {"struct {", "struct s { s x; }", "struct s { none x; }", "\xff\xfe", "enum e { A }"})
    EXPECT_TRUE(dut.Take(text(1, 0, 1, words)));
  Bytes torn = text(1, 0, 1, "struct s { int8_t a; }");
  torn.resize(torn.size() - 3);
  EXPECT_TRUE(dut.Take(torn));
  EXPECT_FALSE(dut.Take(ThenWay()));
  EXPECT_EQ(dut.Of(ThenWay()), nullptr);
  for (std::size_t i = 0; i < 2 * LogTypes::kMostTypes; ++i)
    dut.Take(text(static_cast<std::int64_t>(i), 0, 2, std::string(1200, 'x')));
}

}  // namespace
}  // namespace priamos::bus
