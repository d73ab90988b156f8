#include "bus/log.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

class Log : public testing::Test {
 protected:
  std::vector<std::byte> WriteSmallLog(int events) {
    {
      LogWriter writer(path_);
      for (int i = 0; i < events; ++i) writer.Write(1000 + i, i % 2 ? "POSE" : "HEALTH", Payload(i));
    }
    std::ifstream file(path_, std::ios::binary);
    std::vector<char> chars(std::istreambuf_iterator<char>(file), {});
    std::vector<std::byte> bytes(chars.size());
    std::memcpy(bytes.data(), chars.data(), chars.size());
    return bytes;
  }

  static std::vector<std::byte> Payload(int i) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(20 + i % 7));
    for (std::size_t k = 0; k < bytes.size(); ++k)
      bytes[k] = static_cast<std::byte>(i * 31 + static_cast<int>(k));
    return bytes;
  }

  const TemporaryFolder folder_;
  const std::string path_ = (folder_ / "test.lcmlog").string();
};

TEST_F(Log, ReadsBackWhatWasWritten) {
  WriteSmallLog(10);
  LogReader dut(path_);
  for (int i = 0; i < 10; ++i) {
    const auto event = dut.Next();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->number, i);
    EXPECT_EQ(event->utime, 1000 + i);
    EXPECT_EQ(event->channel, i % 2 ? "POSE" : "HEALTH");
    EXPECT_EQ(event->bytes, Payload(i));
  }
  EXPECT_FALSE(dut.Next());
  EXPECT_EQ(dut.skipped_bytes(), 0u);
}

TEST_F(Log, EveryUndamagedEventIsReadWhateverByteIsFlipped) {
  const auto bytes = WriteSmallLog(30);
  std::vector<std::pair<std::size_t, std::size_t>> spans;  // begin and end of each event
  for (std::size_t at = 0, i = 0; at < bytes.size(); ++i) {
    const std::size_t size = 28 + (i % 2 ? 4 : 6) + Payload(static_cast<int>(i)).size();
    spans.emplace_back(at, at + size);
    at += size;
  }
  for (std::size_t flip = 0; flip < bytes.size(); ++flip) {
    auto damaged = bytes;
    damaged[flip] ^= std::byte{0xff};
    LogReader dut(damaged);
    std::vector<bool> seen(spans.size());
    while (const auto event = dut.Next())
      if (event->number >= 0 && event->number < static_cast<std::int64_t>(seen.size()) &&
          event->bytes == Payload(static_cast<int>(event->number)))
        seen[static_cast<std::size_t>(event->number)] = true;
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const bool hit = flip >= spans[i].first && flip < spans[i].second;
      ASSERT_TRUE(hit || seen[i]) << "event " << i << " lost by damage at byte " << flip;
    }
  }
}

TEST_F(Log, TruncatedLogEndsWithItsLastWholeEvent) {
  auto bytes = WriteSmallLog(3);
  bytes.resize(bytes.size() - 5);
  LogReader dut(bytes);
  EXPECT_TRUE(dut.Next());
  EXPECT_TRUE(dut.Next());
  EXPECT_FALSE(dut.Next());
  EXPECT_GT(dut.skipped_bytes(), 0u);
}

TEST_F(Log, AbsentFileIsASentence) {
  EXPECT_THROW(LogReader("/nowhere/a.lcmlog"), std::runtime_error);
}

}  // namespace
}  // namespace priamos::bus
