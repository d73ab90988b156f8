#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/schema.hpp"
#include "bus/type_files.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

// The types of a large robot as its repositories hold them: a folder per package, packages within packages,
// types that hold those of other packages; and one that needs a type which nobody has.

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr int kTypes = 59, kBroken = 23;
constexpr const char* kPackages[] = {"base", "base.arm", "sight.map", "sight.map.cells", "plan"};

std::string PackageOf(int type) {
  return kPackages[static_cast<std::size_t>(type) % std::size(kPackages)];
}

std::string NameOf(int type) {
  return fmt::format("{}.kind{}_t", PackageOf(type), type);
}

/// The type that this one holds.
int EarlierThan(int type) {
  return type / 2 == kBroken ? 0 : type / 2;
}

/// A type with fields of all sorts, among them one and several of an earlier type, mostly of another package.
std::string TextOf(int type) {
  const int earlier = EarlierThan(type);
  // A name of its own: LCM's fingerprint does not tell the names of types.
  std::string fields = fmt::format(
      "  int64_t when{};\n  int16_t n;\n  double rows[n][3];\n  string names[2];\n  byte raw[n];\n", type);
  if (type > 0) fields += fmt::format("  {} part;\n  {} parts[n];\n", NameOf(earlier), NameOf(earlier));
  if (type == kBroken) fields += "  mail.envelope_t envelope;\n";
  return fmt::format("package {};\n// Kind {}.\nstruct kind{}_t {{\n  const int32_t KIND = {};\n{}}}\n",
                     PackageOf(type), type, type, type, fields);
}

bus::Json MessageOf(int type) {
  bus::Json message{{fmt::format("when{}", type), type},
                    {"rows", {{0.5, 1.5, type}}},
                    {"names", {"a", ""}},
                    {"raw", "AA=="}};
  if (type > 0) {
    message["part"] = MessageOf(EarlierThan(type));
    message["parts"] = bus::Json::array({message["part"]});
  }
  return message;
}

class ForeignFolder : public testing::Test {
 protected:
  ForeignFolder() {
    for (int type = 0; type < kTypes; ++type) {
      std::string package = PackageOf(type);
      std::replace(package.begin(), package.end(), '.', '/');
      const auto in = types_ / "lcmtypes" / package;
      std::filesystem::create_directories(in);
      std::ofstream(in / fmt::format("kind{}_t.lcm", type)) << TextOf(type);
    }
  }
  /// A message of every type that can be used, each on a channel of its own.
  void WriteLog() const {
    std::vector<std::string> problems;
    const bus::Schema schema(bus::ReadTypeFiles(types_), problems);
    MessageLog log(log_);
    for (int type = 0; type < kTypes; ++type)
      if (const bus::Struct* known = schema.Find(NameOf(type)))
        log.AddBytes(type, fmt::format("KIND{}", type), bus::FromJson(*known, MessageOf(type)));
  }

  const TemporaryFolder folder_;
  const std::filesystem::path types_ = folder_ / "robot";
  const std::string log_ = folder_ / "run.lcmlog";
};

TEST_F(ForeignFolder, TheOneTypeThatCannotBeUsedIsNamedAndAllOthersAreKnown) {
  const auto answer = Priamos({"type", "hash", "--types", types_});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(LinesOf(answer.err).size(), 1u) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr(fmt::format("kind{}_t.lcm:12: {}.envelope: expected a type that is "
                                                "defined, got mail.envelope_t",
                                                kBroken, NameOf(kBroken))));
  for (int type = 0; type < kTypes; ++type) {
    const auto known = HasSubstr(NameOf(type) + "\n");
    if (type == kBroken)
      EXPECT_THAT(answer.out, Not(known));
    else
      EXPECT_THAT(answer.out, known);
  }
}

TEST_F(ForeignFolder, AMessageOfEachOtherTypeIsDecoded) {
  WriteLog();
  const auto info = json::parse(Priamos({"log", "info", log_, "--json", "--types", types_}).out);
  EXPECT_EQ(info.at("channels").size(), kTypes - 1u);
  EXPECT_EQ(info.at("undecodable"), 0);
  const auto lines = LinesOf(Priamos({"log", "export", log_, "jsonl", "--types", types_}).out);
  ASSERT_EQ(lines.size(), kTypes - 1u);
  EXPECT_EQ(json::parse(lines.back()).at("type"), NameOf(kTypes - 1));
  EXPECT_EQ(
      json::parse(lines.back()).at("message").at("part").at(fmt::format("when{}", EarlierThan(kTypes - 1))),
      EarlierThan(kTypes - 1));
}

}  // namespace
}  // namespace priamos::cli
