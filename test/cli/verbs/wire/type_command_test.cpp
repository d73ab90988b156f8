#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::string HashOf(std::int64_t fingerprint) {
  return fmt::format("0x{:016x}", static_cast<std::uint64_t>(fingerprint));
}

TEST(TypeCommand, TheHashIsThatOfTheGeneratedCode) {
  EXPECT_EQ(Priamos({"type", "hash", "pose_t"}).out, HashOf(pose_t::getHash()) + "  priamos.pose_t\n");
  EXPECT_EQ(json::parse(Priamos({"type", "hash", "priamos.estop_t", "--json"}).out),
            json({{"priamos.estop_t", HashOf(estop_t::getHash())}}));
}

TEST(TypeCommand, WithoutANameEveryTypeHasALine) {
  const auto lines = LinesOf(Priamos({"type", "hash"}).out);
  const auto all = json::parse(Priamos({"type", "hash", "--json"}).out);
  EXPECT_EQ(lines.size(), all.size());
  EXPECT_GE(all.size(), std::tuple_size_v<decltype(channels::kAll)>);
  EXPECT_EQ(all.at("priamos.health_t"), HashOf(health_t::getHash()));
}

TEST(TypeCommand, ShowHasConstantsFieldsAndSizes) {
  const auto answer = Priamos({"type", "show", "estop_t"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto lines = LinesOf(answer.out);
  EXPECT_THAT(lines[0],
              AllOf(StartsWith("priamos.estop_t  " + HashOf(estop_t::getHash())), HasSubstr("estop_t.lcm:")));
  EXPECT_THAT(answer.out, HasSubstr("  const int8_t STOP = 1\n"));
  EXPECT_THAT(answer.out, HasSubstr("on LCM at most 18 bytes")) << "fingerprint 8, int64 8, two of one byte";
  EXPECT_THAT(answer.out, HasSubstr("who did it, constant of lease_request_t"));
}

TEST(TypeCommand, ArraysShowTheirDimensions) {
  EXPECT_THAT(Priamos({"type", "show", "sonar_ranges_t"}).out, HasSubstr("range_m[24]"));
  EXPECT_THAT(Priamos({"type", "show", "landmark_view_t"}).out, HasSubstr("edges[n_edges]"));
}

TEST(TypeCommand, ShowAsJsonIsASchemaOfItsFields) {
  const auto dut = json::parse(Priamos({"type", "show", "estop_t", "--json"}).out);
  EXPECT_TRUE(dut.at("properties").contains("action"));
  EXPECT_EQ(dut.at("properties").size(), 3u);
}

TEST(TypeCommand, AnUnknownTypeIsRefusedWithTheNearest) {
  for (const char* verb : {"show", "hash"}) {
    const auto answer = Priamos({"type", verb, "pose"});
    EXPECT_EQ(answer.exit_code, 2) << verb;
    EXPECT_THAT(answer.err, AllOf(HasSubstr("unknown type \"pose\"; nearest: \"pose_t\""),
                                  HasSubstr("(priamos type hash lists all)")));
  }
}

TEST(TypeCommand, TheTableOfChannelsHasEveryChannelInBothForms) {
  constexpr std::size_t kChannels = std::tuple_size_v<decltype(channels::kAll)>;
  EXPECT_EQ(LinesOf(Priamos({"type", "channels"}).out).size(), 2 + kChannels);
  EXPECT_EQ(json::parse(Priamos({"type", "channels", "--json"}).out).size(), kChannels);
}

class ForeignTypes : public testing::Test {
 protected:
  ForeignTypes() {
    std::ofstream(folder_ / "their_t.lcm") << "package their;\n// Somebody else's.\nstruct their_t {\n"
                                              "  int32_t n;\n  double values[n];\n  string name;\n}\n";
  }
  TemporaryFolder folder_;
};

TEST_F(ForeignTypes, AreReadFromTheirFolder) {
  const auto answer = Priamos({"type", "show", "their_t", "--types", folder_.path()});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out,
              AllOf(StartsWith("their.their_t"), HasSubstr("Somebody else's."), HasSubstr("values[n]")));
}

TEST_F(ForeignTypes, WithoutBoundsHaveNoLargestSize) {
  EXPECT_THAT(Priamos({"type", "show", "their_t", "--types", folder_.path()}).out,
              HasSubstr("on LCM of no bounded size; packed of no bounded size"));
}

TEST_F(ForeignTypes, HideOurOwn) {
  const auto answer = Priamos({"type", "hash", "pose_t", "--types", folder_.path()});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("unknown type \"pose_t\""));
}

TEST_F(ForeignTypes, OneThatCannotBeReadIsNamedOnceAndTheOthersWork) {
  std::ofstream(folder_ / "wrong_t.lcm") << "struct wrong_t {\n  int32_t\n}\nstruct open_t { none_t x; }\n";
  const std::string file = folder_ / "wrong_t.lcm";
  const std::string named = file + ":3: expected the name of the field, got '}'\n" + file +
                            ":4: open_t.x: expected a type that is defined, got none_t\n";
  const auto good = Priamos({"type", "hash", "--types", folder_.path()});
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_THAT(good.out, HasSubstr("their.their_t"));
  EXPECT_EQ(good.err, named);
  for (const char* verb : {"show", "hash"})
    for (const std::string name : {"wrong_t", "open_t"}) {
      const auto answer = Priamos({"type", verb, name, "--types", folder_.path()});
      EXPECT_EQ(answer.exit_code, 2);
      EXPECT_EQ(answer.err, named + "priamos type " + verb + ": expected a type that can be used, got \"" +
                                name + "\"; the reason stands above\n");
    }
}

TEST_F(ForeignTypes, OfWhichNoneCanBeUsedAreRefused) {
  TemporaryFolder wrong;
  std::ofstream(wrong / "a.lcm") << "struct a {\n  int32_t\n}\n";
  const auto one = Priamos({"type", "hash", "--types", wrong.path()});
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_EQ(one.err, "priamos type hash: " + (wrong / "a.lcm").string() +
                         ":3: expected the name of the field, got '}'\n");
  std::ofstream(wrong / "b.lcm") << "enum b { A }\n";
  const auto two = Priamos({"type", "hash", "--types", wrong.path()});
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.err, HasSubstr("--types: expected types that can be used, got none"));
}

TEST_F(ForeignTypes, MayComeFromSeveralFolders) {
  TemporaryFolder other;
  std::filesystem::create_directories(other / "deep/er");
  std::ofstream(other / "deep/er/other_t.lcm") << "package other;\nstruct other_t {\n  their.their_t t;\n}\n";
  const auto answer = Priamos({"type", "hash", "--types", folder_.path(), "--types", other.path()});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, AllOf(HasSubstr("their.their_t"), HasSubstr("other.other_t")));
  EXPECT_EQ(answer.err, "");
}

TEST_F(ForeignTypes, FromAFolderThatIsNotThereAreRefused) {
  const auto answer = Priamos({"type", "hash", "--types", folder_ / "none"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--types: expected an existing folder"));
}

/// 46 lines of text define a message of 8 bytes that is 2^45 structs.
TEST(TypeCommand, ATypeThatDoublesOftenIsShownAndHasNoJsonSchema) {
  const TemporaryFolder folder;
  std::ofstream file(folder / "doubles.lcm");
  for (int i = 0; i < 45; ++i) file << fmt::format("struct c{0}_t {{ c{1}_t a; c{1}_t b; }}\n", i, i + 1);
  file << "struct c45_t {}\n";
  file.close();
  const auto shown = Priamos({"type", "show", "c0_t", "--types", folder.path().string()});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("on LCM at most 8 bytes; packed of no bounded size"));
  const auto json = Priamos({"type", "show", "c0_t", "--json", "--types", folder.path().string()});
  EXPECT_EQ(json.exit_code, 2);
  EXPECT_THAT(json.err, HasSubstr("expected a type of at most 10000 structs within each other, got c0_t"));
}

}  // namespace
}  // namespace priamos::cli
