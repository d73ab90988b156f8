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
  const auto texts = TypeScribe([](auto bytes) { return kThen.Of(bytes); }).TextsBefore(ThenWay(), 7);
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
  const auto texts = TypeScribe([&](auto bytes) { return schema.Of(bytes); }).TextsBefore(message, 0);
  EXPECT_GE(texts.size(), 3u);
  LogTypes dut(nullptr);
  EXPECT_EQ(dut.Of(message), nullptr);
  for (auto at = texts.rbegin(); at != texts.rend(); ++at) {
    EXPECT_LE(at->size(), 1400u) << "a player sends it as one datagram";
    EXPECT_TRUE(ToJson(*OwnTypes().Find("type_text_t"), *at)["text"].is_string()) << "UTF-8";
    EXPECT_TRUE(dut.Take(*at)) << "in whatever order";
  }
  ASSERT_NE(dut.Of(message), nullptr);
  EXPECT_EQ(dut.Of(message)->fields.size(), 100u);
}

/// A part of a text that is claimed to define the type of `fingerprint`.
Bytes TextPart(std::uint64_t fingerprint, const std::string& text, std::size_t part = 0,
               std::size_t parts = 1) {
  static const Schema own = OwnTypes();
  return FromJson(*own.Find("type_text_t"), Json{{"utime", 0},
                                                 {"fingerprint", static_cast<std::int64_t>(fingerprint)},
                                                 {"part", part},
                                                 {"parts", parts},
                                                 {"text", text}});
}

std::vector<Bytes> TextParts(std::uint64_t fingerprint, const std::string& text) {
  constexpr std::size_t kBytes = 1000;
  std::vector<Bytes> parts;
  const std::size_t count = (text.size() + kBytes - 1) / kBytes;
  for (std::size_t i = 0; i < count; ++i)
    parts.push_back(TextPart(fingerprint, text.substr(kBytes * i, kBytes), i, count));
  return parts;
}

/// A chain of types of which each holds the next one.
std::string Chain(std::size_t types) {
  std::string text;
  for (std::size_t i = 0; i + 1 < types; ++i) text += fmt::format("struct c{}_t {{ c{}_t a; }}\n", i, i + 1);
  return text + fmt::format("struct c{}_t {{ int8_t x; }}", types - 1);
}

TEST_F(TypeTexts, ATextOfMoreTypesThanARecorderWritesIsNotRead) {
  const Bytes message = MessageBuilder(*SchemaOf(Chain(200)).Find("c0_t")).Put<std::int8_t>(1).bytes();
  const auto fingerprint = FingerprintOf(message.data(), message.size());
  const auto takes = [&](const std::string& text) {
    LogTypes dut(nullptr);
    for (const Bytes& part : TextParts(fingerprint, text)) dut.Take(part);
    return dut.Of(message) != nullptr;
  };
  EXPECT_TRUE(takes(Chain(200)));
  std::string more = Chain(200);
  for (std::size_t i = 0; i < LogTypes::kMostTypesOfText; ++i) more += fmt::format("struct m{}_t {{}}", i);
  EXPECT_FALSE(takes(more));
  EXPECT_FALSE(takes(Chain(200) + std::string(LogTypes::kMostBytesOfText, ' ')));
}

TEST_F(TypeTexts, OneTextMayDefineManyTypes) {
  std::string text;
  for (std::size_t i = 0; i < 200; ++i) text += fmt::format("struct t{}_t {{ int8_t x{}; }}\n", i, i);
  const Schema schema = SchemaOf(text);
  LogTypes dut(nullptr);
  for (std::size_t i = 0; i < 200; ++i) {
    const Struct& type = *schema.Find(fmt::format("t{}_t", i));
    for (const Bytes& part : TextParts(type.fingerprint, text)) dut.Take(part);
    const Struct* found = dut.Of(MessageBuilder(type).Put<std::int8_t>(1).bytes());
    ASSERT_NE(found, nullptr) << i;
    EXPECT_EQ(found->name, type.name);
  }
}

TEST_F(TypeTexts, CommentsInLatin1AreReadAndTheTypesUsed) {
  const std::string text = "struct old_t {\n  double d_m;  // [m] @range 0,1 @step 0.1: L\xE4nge\n}";
  const Schema schema = SchemaOf(text);
  const Struct& type = *schema.Find("old_t");
  EXPECT_EQ(type.fields[0].annotation.meaning, "L\xC3\xA4nge");
  const Bytes message = MessageBuilder(type).Put(0.5).bytes();
  LogTypes dut(nullptr);
  // As a recorder of before wrote it: byte for byte.
  Bytes part =
      TextPart(type.fingerprint, "struct old_t {\n  double d_m;  // [m] @range 0,1 @step 0.1: L#nge\n}");
  *std::find(part.begin() + 32, part.end(), std::byte{'#'}) = std::byte{0xE4};
  dut.Take(part);
  ASSERT_NE(dut.Of(message), nullptr);
  EXPECT_EQ(dut.Of(message)->fields[0].annotation.meaning, "L\xC3\xA4nge");
  const std::string log = Write("latin", schema, message);
  EXPECT_THAT(Lines(log, SchemaOf("")), HasSubstr(R"("message":{"d_m":0.5})"));
  LogReader reader(log);
  std::ostringstream mcap;
  EXPECT_EQ(ExportMcap(reader, SchemaOf(""), {}, mcap).written, 3u) << "its JSON schema has the comment";
}

/// What may stand in a log before, between and behind the parts of the genuine text of kThen's p.way_t.
TEST_F(TypeTexts, ForgedAndDamagedTextsHideNoGenuineOne) {
  const std::uint64_t fingerprint = kThen.Find("p.way_t")->fingerprint;
  const std::string genuine =
      "package p; struct point_t { double x; } struct way_t { int8_t n; point_t at[n]; }";
  const std::string other_name =
      "package q; struct point_t { double x; } struct forged_t { int8_t n; point_t at[n]; }";
  const std::vector<Bytes> whole = {TextPart(fingerprint, genuine)};
  const std::vector<Bytes> halves = {TextPart(fingerprint, genuine.substr(0, 40), 0, 2),
                                     TextPart(fingerprint, genuine.substr(40), 1, 2)};
  std::vector<Bytes> forged;
  for (const std::string& text : {std::string("struct {"), std::string("struct s { int8_t a; }"), other_name,
                                  std::string(1200, 'x'), std::string()}) {
    forged.push_back(TextPart(fingerprint, text));
    for (const std::size_t part : {0, 1}) forged.push_back(TextPart(fingerprint, text, part, 2));
  }
  for (const auto& texts : {whole, halves}) {
    LogTypes dut(nullptr);
    for (int flood = 0; flood < 3; ++flood)
      for (const Bytes& text : forged) dut.Take(text);
    for (const Bytes& text : texts) dut.Take(text);
    ASSERT_NE(dut.Of(ThenWay()), nullptr);
    EXPECT_EQ(dut.Of(ThenWay())->full_name, "p.way_t");
    for (const Bytes& text : forged) dut.Take(text);
    EXPECT_EQ(dut.Of(ThenWay())->full_name, "p.way_t") << "what comes later changes nothing";
  }
}

/// Another recorder than ours has them where they came over the bus: long before the first message.
TEST_F(TypeTexts, AFloodOfForgedTextsBehindTheGenuineOneDoesNotHideIt) {
  const std::uint64_t fingerprint = kThen.Find("p.way_t")->fingerprint;
  const std::string genuine =
      "package p; struct point_t { double x; } struct way_t { int8_t n; point_t at[n]; }";
  for (const std::size_t parts : {1, 2}) {
    const std::size_t size = genuine.size() / parts + 1;
    LogTypes dut(nullptr);
    for (std::size_t i = 0; i < parts; ++i)
      dut.Take(TextPart(fingerprint, genuine.substr(i * size, size), i, parts));
    for (std::size_t i = 0; i < 200; ++i)
      dut.Take(TextPart(fingerprint, fmt::format("struct forged{}_t {{ int8_t a; }}", i), i % parts, parts));
    EXPECT_NE(dut.Of(ThenWay()), nullptr) << parts << " parts";
  }
}

TEST_F(TypeTexts, OneForgedPartAfterTheGenuineOnesIsLeftOut) {
  const std::uint64_t fingerprint = kThen.Find("p.way_t")->fingerprint;
  const std::string genuine =
      "package p; struct point_t { double x; } struct way_t { int8_t n; point_t at[n]; }";
  for (const std::size_t forged : {0, 1}) {
    LogTypes dut(nullptr);
    dut.Take(TextPart(fingerprint, genuine.substr(0, 40), 0, 2));
    dut.Take(TextPart(fingerprint, genuine.substr(40), 1, 2));
    dut.Take(TextPart(fingerprint, "forged", forged, 2));
    EXPECT_NE(dut.Of(ThenWay()), nullptr) << forged;
  }
}

/// LCM's fingerprint is the same when two fields exchange their types.
TEST_F(TypeTexts, OfTwoTypesOfOneFingerprintTheOneIsTakenThatTheMessageObeys) {
  const std::string types = "struct name_t { string s; } struct size_t { int32_t n; } ";
  const std::string genuine = types + "struct c_t { name_t a; size_t b; }";
  const std::string forged = types + "struct c_t { size_t a; name_t b; }";
  const Schema schema = SchemaOf(genuine);
  const Struct& type = *schema.Find("c_t");
  ASSERT_EQ(type.fingerprint, SchemaOf(forged).Find("c_t")->fingerprint);
  const Bytes message = FromJson(type, Json::parse(R"({"a": {"s": "ab"}, "b": {"n": 7}})"));
  for (const bool forged_last : {true, false}) {
    LogTypes dut(nullptr);
    dut.Take(TextPart(type.fingerprint, forged_last ? genuine : forged));
    dut.Take(TextPart(type.fingerprint, forged_last ? forged : genuine));
    ASSERT_NE(dut.Of(message), nullptr);
    EXPECT_EQ(dut.Of(message)->fields[0].type_name, "name_t");
  }
}

TEST_F(TypeTexts, AFloodOfOtherTypesHidesNoGenuineOne) {
  LogTypes dut(nullptr);
  const std::uint64_t fingerprint = kThen.Find("p.way_t")->fingerprint;
  for (std::uint64_t i = 1; i <= LogTypes::kMostTypes + 10; ++i)
    dut.Take(TextPart(i, "struct s { int8_t a; }"));
  dut.Take(TextPart(fingerprint,
                    "package p; struct point_t { double x; } struct way_t { int8_t n; point_t at[n]; }"));
  EXPECT_NE(dut.Of(ThenWay()), nullptr);
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
