// bus/python against the C++ side: fingerprints, JSON, encoding, packing and refusals of random messages, and
// logs.

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "bus/log/log_export.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/packing.hpp"
#include "bus/schema/walk.hpp"
#include "bus/type_files.hpp"
#include "test/bus/schema/mutator.hpp"
#include "test/bus/schema/random_message.hpp"
#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kNow_us = 1'800'000'000'000'000;
const std::string kSource = PRIAMOS_SOURCE_DIR;

std::string Hex(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte b : bytes) {
    text += "0123456789abcdef"[std::to_integer<int>(b) >> 4];
    text += "0123456789abcdef"[std::to_integer<int>(b) & 15];
  }
  return text;
}

Schema AllTypes() {
  auto sources = ReadTypeFiles(kSource + "/lcmtypes");
  for (auto& source : ReadTypeFiles(kSource + "/test/bus/schema/foreign"))
    sources.push_back(std::move(source));
  return Schema(sources);
}

ShellAnswer Python(const std::string& script) {
  return RunShell("cd '" + kSource +
                  "' && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=bus/python timeout 120 python3 " + script);
}

std::vector<std::string> NamesOf(const Packer& packer, const std::vector<std::uint16_t>& rows) {
  std::vector<std::string> names;
  for (const std::uint16_t row : rows) names.push_back(packer.fields()[row].name);
  return names;
}

/// What C++ makes of a message: whether it is one, and then as JSON and packed.
Json AsVector(const Struct& type, const Bytes& bytes) {
  Json vector{{"type", type.full_name}, {"encoded", Hex(bytes)}, {"taken", bool(Walk(type, bytes))}};
  if (!vector["taken"]) return vector;
  vector["json"] = ToJson(type, bytes);
  try {
    const Packer packer(type);
    const auto packed = packer.Pack(bytes, kNow_us);
    vector["packed"] = Hex(packed->bytes);
    vector["saturated"] = NamesOf(packer, packed->saturated);
    vector["refused"] = NamesOf(packer, packed->refused);
    if (packed->refused.empty()) vector["unpacked"] = Hex(*packer.Unpack(packed->bytes, kNow_us + 5));
  } catch (const SchemaError& error) {
    vector["unpackable"] = error.what();
  }
  return vector;
}

TEST(PythonBus, MakesOfMessagesWhatCppMakes) {
  const TemporaryFolder folder;
  const Schema schema = AllTypes();
  std::ofstream file(folder / "vectors.jsonl");
  Rng rng(7);
  for (const Struct* type : schema.All()) {
    file << Json{{"type", type->full_name}, {"fingerprint", type->fingerprint}} << '\n';
    for (int i = 0; i < 16; ++i) {
      Bytes bytes = RandomMessage(*type, i % 2 == 0 ? Values::kAny : Values::kInRange, rng, kNow_us);
      file << AsVector(*type, bytes) << '\n';
      Mutate(bytes, rng);
      file << AsVector(*type, bytes) << '\n';
    }
  }
  file.close();
  const auto ran = Python("test/bus/python/vectors.py '" + (folder / "vectors.jsonl").string() + "'");
  EXPECT_EQ(ran.exit_code, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("messages, the same"));
}

/// A log of own and foreign types, which no Python program knows, with damage in the middle.
std::string DamagedLog(const std::filesystem::path& path, const Schema& schema) {
  {
    LogWriter log(path);
    log.DefineTypesOf(schema);
    Rng rng(8);
    for (int i = 0; i < 60; ++i) {
      const Struct* type = schema.All()[static_cast<std::size_t>(i) % schema.All().size()];
      log.Write(kNow_us + i, type->name, RandomMessage(*type, Values::kAny, rng, kNow_us));
    }
  }
  std::vector<std::streamoff> begins;
  for (LogReader reader(path.string()); const auto event = reader.Next();)
    begins.push_back(static_cast<std::streamoff>(event->offset));
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  for (const std::size_t event : {std::size_t{20}, begins.size() / 2}) {
    file.seekp(begins[event]);
    file.write("damage", 6);
  }
  return path;
}

TEST(PythonBus, ReadsALogOfTypesThatItNeverSawAsExportDoes) {
  const TemporaryFolder folder;
  const Schema schema = AllTypes(), none(std::vector<Schema::Source>{});
  const std::string path = DamagedLog(folder / "run.lcmlog", schema);
  LogReader reader(path);
  std::ostringstream lines;
  const auto count = ExportJsonLines(reader, none, {}, lines);
  EXPECT_GT(count.written, 40u) << "the log defines its types";
  EXPECT_GT(reader.skipped_bytes(), 0u);
  std::ofstream(folder / "cpp.jsonl") << lines.str();
  const auto ran =
      Python("test/bus/python/same_log.py '" + path + "' '" + (folder / "cpp.jsonl").string() + "'");
  EXPECT_EQ(ran.exit_code, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr(std::to_string(count.written) + " messages, the same; " +
                                  std::to_string(reader.skipped_bytes()) + " bytes skipped"));
}

/// Numbers of all magnitudes that a type can hold, and those around which the exponent begins.
template <class T, class Bits>
T AnyNumber(std::mt19937_64& rng) {
  const auto bits = std::bit_cast<T>(static_cast<Bits>(rng()));
  if (rng() % 2 == 0) return bits;
  const double digits =
      std::round(std::pow(10.0, static_cast<double>(rng() % 18)) * static_cast<double>(rng() % 10000));
  return static_cast<T>(digits * std::pow(10.0, -static_cast<double>(rng() % 24)));
}

TEST(PythonBus, PrintsNumbersOfAllMagnitudesAsExportDoes) {
  const TemporaryFolder folder;
  const Schema schema = SchemaOf("struct numbers_t { double d[100]; float f[100]; }");
  const Struct& type = *schema.Find("numbers_t");
  const std::string path = folder / "numbers.lcmlog";
  {
    LogWriter log(path);
    log.DefineTypesOf(schema);
    std::mt19937_64 rng(9);
    for (int i = 0; i < 100; ++i) {
      MessageBuilder message(type);
      for (int k = 0; k < 100; ++k) message.Put(AnyNumber<double, std::uint64_t>(rng));
      for (int k = 0; k < 100; ++k) message.Put(AnyNumber<float, std::uint32_t>(rng));
      log.Write(kNow_us + i, "NUMBERS", message.bytes());
    }
  }
  LogReader reader(path);
  std::ostringstream lines;
  EXPECT_EQ(ExportJsonLines(reader, Schema(std::vector<Schema::Source>{}), {}, lines).written, 100U);
  const auto ran = Python("-m priamos_bus '" + path + "'");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_TRUE(ran.text == lines.str())
      << "the first differs at byte "
      << std::mismatch(ran.text.begin(), ran.text.end(), lines.str().begin()).first - ran.text.begin();
}

/// The readers agree on what is forged, too: test/bus/log/type_texts_test.cpp.
TEST(PythonBus, ForgedAndLatin1DefinitionsAreReadAsExportDoes) {
  const TemporaryFolder folder;
  const Schema own = OwnTypes(), schema = SchemaOf("struct old_t { double d_m; }");
  const Struct& type = *schema.Find("old_t");
  const std::string path = folder / "old.lcmlog";
  {
    LogWriter log(path);
    for (const std::string text : {"struct {", "struct forged_t {\n  double d_m;\n}",
                                   "struct old_t {\n  double d_m;  // [m] L\xE4nge\n}"})
      log.Write(kNow_us, "TYPE_TEXT",
                MessageBuilder(*own.Find("type_text_t"))
                    .Put(kNow_us)
                    .Put(type.fingerprint)
                    .Put(std::int16_t{0})
                    .Put(std::int16_t{1})
                    .Text(text)
                    .bytes());
    log.Write(kNow_us, "OLD", MessageBuilder(type).Put(0.5).bytes());
  }
  LogReader reader(path);
  std::ostringstream lines;
  ExportJsonLines(reader, Schema(std::vector<Schema::Source>{}), {}, lines);
  EXPECT_THAT(lines.str(), HasSubstr(R"("type":"old_t","message":{"d_m":0.5}})"));
  EXPECT_EQ(Python("-m priamos_bus '" + path + "' --types test/bus/schema/foreign").text, lines.str());
}

TEST(PythonBus, ItsOwnTestsPass) {
  for (const std::string script :
       {"priamos_bus_test.py", "priamos_link_test.py", "priamos_link_attack_test.py"}) {
    const auto ran = Python("test/bus/python/" + script);
    EXPECT_EQ(ran.exit_code, 0) << ran.text;
    EXPECT_THAT(ran.text, HasSubstr("\nOK"));
  }
}

TEST(PythonBus, RefusesWhatItCannotReadInOneSentence) {
  for (const std::string what : {"/nowhere", "/dev/zero", "udpm://1.2.3.4:5", "README.md --types /nowhere",
                                 "udpm://239.1.2.3:99999", "onboard --robot ../x"}) {
    const auto refused = Python("-m priamos_bus " + what);
    EXPECT_EQ(refused.exit_code, 2) << what;
    EXPECT_EQ(std::count(refused.text.begin(), refused.text.end(), '\n'), 1) << refused.text;
  }
}

}  // namespace
}  // namespace priamos::bus
