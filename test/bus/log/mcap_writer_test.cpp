#include "bus/log/mcap_writer.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "bus/log/crc32.hpp"

namespace priamos::bus {
namespace {

/// Reads a record's fields, little endian, as the specification (https://mcap.dev/spec) has them. The file is
/// also read with the reference library: verify_mcap.mjs.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T Get() {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      value = static_cast<T>(
          value | static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes_.at(i))) << (8 * i)));
    bytes_.remove_prefix(sizeof(T));
    return value;
  }
  std::string_view Take(std::size_t n) {
    const auto taken = bytes_.substr(0, n);
    EXPECT_EQ(taken.size(), n);
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view Text() { return Take(Get<std::uint32_t>()); }
  bool empty() const { return bytes_.empty(); }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

struct Record {
  std::uint8_t opcode;
  std::string_view content;
  std::size_t offset;
};

std::vector<Record> RecordsOf(std::string_view bytes, std::size_t begin) {
  std::vector<Record> records;
  Fields fields(bytes);
  while (!fields.empty()) {
    const std::size_t offset = begin + bytes.size() - fields.rest().size();
    const auto opcode = fields.Get<std::uint8_t>();
    records.push_back({opcode, fields.Take(fields.Get<std::uint64_t>()), offset});
  }
  return records;
}

class McapTest : public testing::Test {
 protected:
  /// 3000 messages of 1 kB in two channels: three chunks.
  McapTest() {
    std::ostringstream out;
    McapWriter dut(out);
    const auto schema = dut.AddSchema("pose_t", R"({"type":"object"})");
    const auto a = dut.AddChannel("A", schema), b = dut.AddChannel("B", schema);
    for (std::uint32_t i = 0; i < 3000; ++i)
      dut.AddMessage(i % 3 ? a : b, i, 1000 * i, "{\"x\":\"" + std::string(1000, 'x') + "\"}");
    dut.Finish();
    file_ = out.str();
    records_ = RecordsOf(std::string_view(file_).substr(8, file_.size() - 16), 8);
  }
  std::string file_;
  std::vector<Record> records_;
};

TEST(Crc32, HasTheStandardsCheckValue) {
  EXPECT_EQ(Crc32(0, "123456789"), 0xCBF43926u);
  EXPECT_EQ(Crc32(Crc32(0, "1234"), "56789"), 0xCBF43926u);
}

TEST_F(McapTest, BeginsAndEndsWithItsMagic) {
  EXPECT_EQ(file_.substr(0, 8), std::string("\x89MCAP0\r\n"));
  EXPECT_EQ(file_.substr(file_.size() - 8), std::string("\x89MCAP0\r\n"));
  EXPECT_EQ(records_.front().opcode, 0x01);
  EXPECT_EQ(records_.back().opcode, 0x02);
}

TEST_F(McapTest, ChunksHoldEveryMessageInOrder) {
  std::uint32_t next = 0;
  int chunks = 0;
  for (const auto& record : records_) {
    if (record.opcode != 0x06) continue;
    ++chunks;
    Fields chunk(record.content);
    const auto start = chunk.Get<std::uint64_t>(), end = chunk.Get<std::uint64_t>();
    const auto size = chunk.Get<std::uint64_t>();
    const auto crc = chunk.Get<std::uint32_t>();
    EXPECT_EQ(chunk.Text(), "");  // not compressed
    const auto content = chunk.Take(chunk.Get<std::uint64_t>());
    EXPECT_EQ(content.size(), size);
    EXPECT_EQ(Crc32(0, content), crc);
    for (const auto& inner : RecordsOf(content, 0)) {
      if (inner.opcode != 0x05) continue;
      Fields message(inner.content);
      EXPECT_EQ(message.Get<std::uint16_t>(), next % 3 ? 1 : 2);
      EXPECT_EQ(message.Get<std::uint32_t>(), next);
      const auto time = message.Get<std::uint64_t>();
      EXPECT_EQ(time, 1000u * next);
      EXPECT_TRUE(start <= time && time <= end);
      ++next;
    }
  }
  EXPECT_EQ(next, 3000u);
  EXPECT_EQ(chunks, 3);
}

TEST_F(McapTest, ChunkIndexesLeadToChunks) {
  int indexes = 0;
  for (const auto& record : records_) {
    if (record.opcode != 0x08) continue;
    Fields index(record.content);
    index.Take(16);
    const auto offset = index.Get<std::uint64_t>(), length = index.Get<std::uint64_t>();
    EXPECT_EQ(file_[offset], 0x06);
    EXPECT_EQ(file_[offset + length], 0x07);  // message indexes follow
    ++indexes;
  }
  EXPECT_EQ(indexes, 3);
}

TEST_F(McapTest, FooterLeadsToTheSummaryAndChecksIt) {
  Fields footer(records_.back().content);
  const auto summary = footer.Get<std::uint64_t>(), offsets = footer.Get<std::uint64_t>();
  const auto crc = footer.Get<std::uint32_t>();
  EXPECT_EQ(file_[summary], 0x03);
  EXPECT_EQ(file_[offsets], 0x0E);
  const std::size_t end = file_.size() - 8 - 4;
  EXPECT_EQ(Crc32(0, std::string_view(file_).substr(summary, end - summary)), crc);
}

TEST_F(McapTest, StatisticsCount) {
  for (const auto& record : records_) {
    if (record.opcode != 0x0B) continue;
    Fields statistics(record.content);
    EXPECT_EQ(statistics.Get<std::uint64_t>(), 3000u);
    EXPECT_EQ(statistics.Get<std::uint16_t>(), 1u);
    EXPECT_EQ(statistics.Get<std::uint32_t>(), 2u);
    return;
  }
  FAIL() << "no statistics";
}

TEST(Mcap, AnEmptyFileIsStillOne) {
  std::ostringstream out;
  McapWriter dut(out);
  dut.Finish();
  const std::string file = out.str();
  EXPECT_EQ(RecordsOf(std::string_view(file).substr(8, file.size() - 16), 8).back().opcode, 0x02);
}

}  // namespace
}  // namespace priamos::bus
