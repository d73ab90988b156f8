#include "bus/log/log_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>

#include "bus/log/log_writer.hpp"
#include "bus/wire/reassembler.hpp"
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

  TemporaryFolder folder_;
  std::string path_ = (folder_ / "test.lcmlog").string();
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

/// Flips every byte of a log of 64 kB in turn: whatever is not hit is read, and what is not read is told.
void FlipEveryByte(std::vector<std::byte> bytes, std::byte mask) {
  std::vector<LogEvent> whole;
  LogReader reader(bytes);
  while (auto event = reader.Next()) whole.push_back(std::move(*event));
  for (std::size_t flip = 0; flip < bytes.size(); ++flip) {
    bytes[flip] ^= mask;
    LogReader dut(bytes);
    std::size_t missed = 0, at = 0;
    for (auto event = dut.Next(); event; event = dut.Next()) {
      while (at < whole.size() && whole[at].offset < event->offset) {
        ++missed;
        ++at;
      }
      if (at == whole.size() || whole[at].offset != event->offset) continue;  // not one that was written
      const bool hit = flip >= event->offset && (at + 1 == whole.size() || flip < whole[at + 1].offset);
      const bool same = event->number == whole[at].number && event->utime == whole[at].utime &&
                        event->channel == whole[at].channel && event->bytes == whole[at].bytes;
      ASSERT_TRUE(hit || same) << "event " << at << " changed by damage at byte " << flip;
      ++at;
    }
    missed += whole.size() - at;
    ASSERT_LE(missed, 1u) << "undamaged events lost by damage at byte " << flip;
    if (missed > 0) {
      ASSERT_GT(dut.skipped_bytes(), 0u) << "a loss at byte " << flip << " is not told";
    }
    bytes[flip] ^= mask;
  }
}

TEST_F(Log, EveryUndamagedEventOf64kBIsReadWhateverByteIsInverted) {
  FlipEveryByte(WriteSmallLog(1180), std::byte{0xff});
}

TEST_F(Log, EveryUndamagedEventOf64kBIsReadWhateverBitIsFlipped) {
  const auto bytes = WriteSmallLog(1180);
  ASSERT_GT(bytes.size(), 64000u);
  FlipEveryByte(bytes, std::byte{0x10});
}

TEST_F(Log, TruncatedLogEndsWithItsLastWholeEvent) {
  auto bytes = WriteSmallLog(3);
  bytes.resize(bytes.size() - 5);
  LogReader dut(bytes);
  EXPECT_TRUE(dut.Next());
  EXPECT_TRUE(dut.Next());
  EXPECT_FALSE(dut.Next());
  EXPECT_GT(dut.skipped_bytes(), 0u);
  EXPECT_EQ(dut.damaged_places(), 1u);
}

TEST_F(Log, AMessageMayHoldTheMagicEvenInTheLastEvent) {
  const std::vector<std::byte> magic{std::byte{0xED}, std::byte{0xA1}, std::byte{0xDA}, std::byte{0x01}};
  {
    LogWriter writer(path_);
    for (int i = 0; i < 2; ++i) writer.Write(i, "RAW", magic);
  }
  LogReader dut(path_);
  EXPECT_EQ(dut.Next()->bytes, magic);
  const auto last = dut.Next();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->bytes, magic);
  EXPECT_EQ(dut.skipped_bytes(), 0u);
}

TEST_F(Log, AMessageThatAnotherFollowsMayHoldAWholeEvent) {
  std::string inner, bytes;
  AppendEvent(inner, 7, 7, "INNER", {});
  AppendEvent(bytes, 0, 0, "RAW", std::as_bytes(std::span(inner)));
  AppendEvent(bytes, 1, 1, "POSE", {});
  LogReader dut(std::as_bytes(std::span(bytes)));
  EXPECT_EQ(dut.Next()->channel, "RAW");
  EXPECT_EQ(dut.Next()->channel, "POSE");
  EXPECT_EQ(dut.skipped_bytes(), 0u);
}

/// Channels and numbers of all events that are read from `bytes`, "POSE 3".
std::vector<std::string> EventsIn(const std::string& bytes) {
  std::vector<std::string> events;
  LogReader dut(std::as_bytes(std::span(bytes)));
  std::size_t in_events = 0;
  while (const auto event = dut.Next()) {
    events.push_back(event->channel + " " + std::to_string(event->number));
    in_events += log_format::kHeaderBytes + event->channel.size() + event->bytes.size();
  }
  EXPECT_EQ(in_events + dut.skipped_bytes(), bytes.size());
  return events;
}

std::string EventOf(std::int64_t number, const std::string& channel, const std::string& data) {
  std::string bytes;
  AppendEvent(bytes, number, 1000 + number, channel, std::as_bytes(std::span(data)));
  return bytes;
}

using Events = std::vector<std::string>;

/// Whether a length that reaches to `end` looks right: nobody can tell then that the event is torn.
bool EndsWell(const std::string& log, std::size_t end) {
  return end == log.size() || log.substr(std::min(end, log.size()), 4) == EventOf(0, "A", "").substr(0, 4);
}

TEST_F(Log, ALastEventMayHoldAWholeOneAlsoBehindATornOne) {
  const std::string inner = EventOf(7, "INNER", "abc");
  for (const std::string& around : {inner, "12345" + inner, inner + "12345", inner + inner}) {
    const std::string last = EventOf(4, "RAW", around);
    EXPECT_EQ(EventsIn(last), (Events{"RAW 4"}));
    const std::string first = EventOf(3, "POSE", std::string(300, 'x'));
    for (std::size_t there = 1; there < first.size(); ++there) {
      const std::string log = first.substr(0, there) + last;
      if (EndsWell(log, first.size())) continue;
      ASSERT_EQ(EventsIn(log), (Events{"RAW 4"})) << there << " bytes of the first";
    }
  }
}

TEST_F(Log, WhatATornEventHoldsIsNotPromoted) {
  const std::string inner = EventOf(7, "INNER", "abc"), before = EventOf(3, "POSE", "x");
  for (const std::string& around : {inner + "0123456789", "12345" + inner + "0123456789"}) {
    const std::string torn = EventOf(4, "RAW", around);
    for (std::size_t there = log_format::kHeaderBytes; there < torn.size(); ++there) {
      ASSERT_EQ(EventsIn(before + torn.substr(0, there)), (Events{"POSE 3"})) << there;
      ASSERT_EQ(EventsIn(torn.substr(0, there)), (Events{})) << there;
    }
  }
}

TEST_F(Log, BehindATornEventThatHoldsOneTheRecordingGoesOn) {
  const std::string inner = EventOf(7, "INNER", "abc");
  const std::string torn = EventOf(4, "RAW", "12345" + inner + std::string(200, 'y'));
  const std::string next = EventOf(0, "POSE", "x") + EventOf(1, "POSE", "x");
  for (std::size_t there = log_format::kHeaderBytes; there < torn.size(); ++there) {
    const std::string log = torn.substr(0, there) + next;
    const bool behind_inner = there == 28 + 3 + 5 + inner.size();  // as if the inner one began the recording
    if (behind_inner || EndsWell(log, torn.size())) continue;
    ASSERT_EQ(EventsIn(log), (Events{"POSE 0", "POSE 1"})) << there;
  }
}

TEST_F(Log, AnEventBeforeADamagedOneMayHoldAWholeOne) {
  const std::string inner = EventOf(7, "INNER", "abc");
  std::string damaged = EventOf(5, "POSE", "x");
  damaged[0] = '?';
  EXPECT_EQ(EventsIn(EventOf(4, "RAW", inner + "1") + damaged + EventOf(6, "POSE", "x")),
            (Events{"RAW 4", "POSE 6"}));
}

TEST_F(Log, ALengthThatReachesIntoTheNextMagicDoesNotSwallowIt) {
  for (char more = 1; more < 33; ++more) {  // 33: to the end of the next one
    std::string bytes = EventOf(4, "RAW", "0123456789");
    bytes[27] = static_cast<char>(bytes[27] + more);
    EXPECT_EQ(EventsIn(bytes + EventOf(5, "POSE", "x") + EventOf(6, "POSE", "y")),
              (Events{"POSE 5", "POSE 6"}))
        << int{more};
  }
}

/// The events of numbers `begin` to `end` on POSE, each with a byte of data.
std::string EventsOf(std::int64_t begin, std::int64_t end) {
  std::string bytes;
  for (; begin < end; ++begin) bytes += EventOf(begin, "POSE", "x");
  return bytes;
}

TEST_F(Log, ALengthThatReachesToTheEndOfALaterEventDoesNotSwallowIt) {
  const std::string one = EventsOf(5, 6);
  for (int swallowed = 1; swallowed < 4; ++swallowed) {
    std::string bytes = EventsOf(4, 10);
    bytes[27] = static_cast<char>(1 + swallowed * static_cast<int>(one.size()));
    EXPECT_EQ(EventsIn(bytes), (Events{"POSE 5", "POSE 6", "POSE 7", "POSE 8", "POSE 9"})) << swallowed;
  }
}

/// Nothing is left out behind a message that carries the next events, so it is none that swallowed them; the
/// same where something is left out, and is not what it carries.
TEST_F(Log, AMessageMayHoldEventsOfTheNextNumbers) {
  for (const std::string& inner : {EventsOf(5, 6), EventsOf(5, 7), "12345" + EventsOf(5, 6)}) {
    EXPECT_EQ(EventsIn(EventOf(4, "RAW", inner) + EventsOf(5, 6)), (Events{"RAW 4", "POSE 5"}));
    EXPECT_EQ(EventsIn(EventOf(4, "RAW", inner) + EventsOf(9, 10)), (Events{"RAW 4", "POSE 9"}));
    EXPECT_EQ(EventsIn(EventOf(4, "RAW", inner)), (Events{"RAW 4"})) << "at the end nobody can tell";
  }
  EXPECT_EQ(EventsIn(EventOf(4, "RAW", EventsOf(5, 6) + "1") + EventsOf(6, 7)), (Events{"RAW 4", "POSE 6"}));
}

TEST_F(Log, ALostNumberIsNoDamage) {
  EXPECT_EQ(EventsIn(EventsOf(4, 5) + EventsOf(6, 7)), (Events{"POSE 4", "POSE 6"}));
}

/// A header of an event that claims `data_bytes`.
std::string HeaderOf(std::int64_t number, std::uint32_t data_bytes) {
  std::string bytes = EventOf(number, "A", "");
  for (std::size_t i = 0; i < 4; ++i) bytes[24 + i] = static_cast<char>(data_bytes >> (24 - 8 * i));
  return bytes;
}

/// Logs of headers alone, one behind the other or within each other, which claim what costs a reader most.
RC_GTEST_PROP(HostileLog, IsReadInTimeInProportionToItsSize, ()) {
  const auto lengths = *rc::gen::container<std::vector<std::uint32_t>>(
      rc::gen::oneOf(rc::gen::inRange(0U, 200U), rc::gen::inRange(0U, 40000U),
                     rc::gen::map(rc::gen::inRange(0U, 1000U), [](std::uint32_t n) { return 29 * n; }),
                     rc::gen::just(64U << 20)));
  const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 4));
  const bool cut = *rc::gen::arbitrary<bool>();
  std::string log;
  std::int64_t number = 0;
  for (int round = 0; round < 20; ++round)
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      number += numbers.empty() ? 1 : numbers[i % numbers.size()];
      log += HeaderOf(number, lengths[i]);
      if (cut && i % 3 == 0) log.resize(log.size() - 5);
    }
  LogReader dut(std::as_bytes(std::span(log)));
  while (dut.Next()) {
  }
  RC_ASSERT(dut.looked_at() <= 3 * log.size());
}

TEST(HostileLog, OfAHundredThousandHeadersIsReadInTimeInProportionToItsSize) {
  const auto looked_at = [](const std::function<std::uint32_t(std::uint32_t)>& length, int step) {
    std::string log;
    for (std::uint32_t i = 0; i < 100'000; ++i) log += HeaderOf(step * static_cast<int>(i), length(i));
    LogReader dut(std::as_bytes(std::span(log)));
    while (dut.Next()) {
    }
    return static_cast<double>(dut.looked_at()) / static_cast<double>(log.size());
  };
  constexpr std::uint32_t kHeader = 29, kEvents = 100'000;
  EXPECT_LE(looked_at([](std::uint32_t) { return 0; }, 2), 3);
  EXPECT_LE(looked_at([](std::uint32_t) { return 64U << 20; }, 1), 3) << "all end behind the file";
  EXPECT_LE(looked_at([](std::uint32_t i) { return kHeader * (kEvents - i - 2); }, 1), 3)
      << "all end at the last one";
  EXPECT_LE(looked_at([](std::uint32_t i) { return kHeader * ((kEvents - i) / 2); }, 2), 3);
  EXPECT_LE(looked_at([](std::uint32_t i) { return i % 2 ? kHeader * 2 : 7; }, 3), 3);
}

TEST_F(Log, ANumberMayBeAny) {
  for (const std::int64_t number : {std::int64_t{1} << 62, INT64_MAX, INT64_MIN, std::int64_t{-1}})
    EXPECT_EQ(EventsIn(EventOf(0, "A", "") + EventOf(number, "POSE", "x").replace(12, 8, 8, '\0')),
              (Events{"A 0", "POSE " + std::to_string(number)}));
}

TEST_F(Log, ATimeThatCannotBeIsDamage) {
  for (const std::int64_t utime : {INT64_MAX, INT64_MIN, log_format::kLargestTime + 1}) {
    std::string bytes;
    AppendEvent(bytes, 0, utime, "POSE", {});
    AppendEvent(bytes, 1, log_format::kLargestTime, "POSE", {});
    LogReader dut(std::as_bytes(std::span(bytes)));
    const auto event = dut.Next();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->number, 1);
    EXPECT_EQ(dut.skipped_bytes(), 32u);
    EXPECT_FALSE(dut.Next());
  }
}

TEST_F(Log, SeekGoesBackToAnEvent) {
  const auto bytes = WriteSmallLog(5);
  LogReader dut(bytes);
  dut.Next();
  const auto second = dut.Next();
  while (dut.Next()) {
  }
  dut.Seek(second->offset);
  EXPECT_EQ(dut.Next()->number, 1);
}

/// Pages of files in the memory of this process [bytes].
std::size_t FilePagesInMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::size_t kilobytes = 0; word == "RssFile:" && status >> kilobytes) return kilobytes * 1024;
  return 0;
}

TEST_F(Log, ALargeLogDoesNotStayInMemory) {
  constexpr int kEvents = 100;
  const std::vector<std::byte> message(std::size_t{1} << 20, std::byte{7});
  {
    LogWriter writer(path_);
    for (int i = 0; i < kEvents; ++i) writer.Write(i, "LARGE", message);
    std::ofstream(path_, std::ios::app) << std::string(std::size_t{50} << 20, '?');
  }
  LogReader dut(path_);
  const std::size_t before = FilePagesInMemory();
  std::size_t most = before, first = 1;
  int events = 0;
  for (; const auto event = dut.Next(); ++events) {
    most = std::max(most, FilePagesInMemory());
    if (events == 1) first = event->offset;
  }
  most = std::max(most, FilePagesInMemory());  // after the damage at the end
  EXPECT_EQ(events, kEvents);
  EXPECT_EQ(dut.skipped_bytes(), std::size_t{50} << 20);
  EXPECT_LT(most - before, std::size_t{30} << 20);
  dut.Seek(first);
  const auto again = dut.Next();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->number, 1);
  EXPECT_EQ(again->bytes, message) << "given back is not lost";
}

TEST_F(Log, EmptyFileHoldsNothing) {
  std::ofstream(path_).close();
  LogReader dut(path_);
  EXPECT_FALSE(dut.Next());
  EXPECT_EQ(dut.skipped_bytes(), 0u);
}

TEST_F(Log, FolderIsASentence) {
  EXPECT_THROW(LogReader(std::string("/tmp")), std::runtime_error);
}

TEST_F(Log, WhatTheKernelMakesUpIsASentence) {
  for (const std::string file : {"/proc/cpuinfo", "/proc/self/mem"}) try {
      LogReader dut(file);
      ADD_FAILURE() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(
          std::string(error.what()),
          file + ": expected a log, got a file without a length, as the kernel makes up in /proc and /sys");
    }
}

TEST_F(Log, APipeIsASentenceAndIsNotWaitedFor) {
  const std::string pipe = path_ + ".pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  try {
    LogReader dut(pipe);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), pipe + ": expected a log, got a pipe");
  }
  std::filesystem::remove(pipe);
}

TEST_F(Log, WhatReadersTakeForDamageIsNamed) {
  const auto damage = [](std::int64_t utime, const std::string& channel, std::size_t cut = 0) {
    std::string bytes;
    AppendEvent(bytes, 0, 1, "A", {});
    AppendEvent(bytes, 1, utime, channel, std::vector<std::byte>(20));
    bytes.resize(bytes.size() - cut);
    LogReader dut(std::as_bytes(std::span(bytes)));
    while (dut.Next()) {
    }
    const auto found = dut.first_damage().value_or(LogReader::Damage{});
    EXPECT_TRUE(found.what.empty() || found.offset == log_format::kHeaderBytes + 1) << found.offset;
    return std::string(found.what);
  };
  EXPECT_EQ(damage(1, "A"), "");
  EXPECT_EQ(damage(log_format::kLargestTime + 1, "A"), "a time beyond the year 2255");
  EXPECT_EQ(damage(1, ""), "a channel without a name");
  EXPECT_EQ(damage(1, "P\xc3\xb6"), "a channel with a name that is not printable ASCII");
  EXPECT_EQ(damage(1, std::string(256, 'x')), "a channel with a name of more than 255 bytes");
  EXPECT_EQ(damage(1, "A", 5), "an event that the file, or the next one, ends in");
  EXPECT_EQ(damage(1, "A", 30), "an event that the file ends in");
}

TEST_F(Log, AMessageAsLargeAsABusCarriesIsRead) {
  std::string bytes;
  AppendEvent(bytes, 0, 1, "BIG", std::vector<std::byte>(log_format::kMostDataBytes));
  AppendEvent(bytes, 1, 1, "SMALL", std::vector<std::byte>(8));
  LogReader dut(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(dut.Next());
  ASSERT_TRUE(dut.Next());
  EXPECT_EQ(dut.damaged_places(), 0u);
  static_assert(log_format::kMostDataBytes == Reassembler::kMostBytes);
}

TEST_F(Log, AbsentFileIsASentence) {
  EXPECT_THROW(LogReader(std::string("/nowhere/a.lcmlog")), std::runtime_error);
}

}  // namespace
}  // namespace priamos::bus
