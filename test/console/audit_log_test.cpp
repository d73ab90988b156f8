#include "console/audit_log.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::console {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

std::vector<AuditLog::Json> Lines(const std::string& file) {
  std::vector<AuditLog::Json> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(AuditLog::Json::parse(line));
  return lines;
}

TEST(AuditLog, EveryActIsALineBehindThoseOfEarlierRuns) {
  const TemporaryFolder folder;
  const std::string file = folder / "audit.jsonl";
  AuditLog(file).Note(FromUtime(5), 1, "joined", {{"role", "driver"}});
  AuditLog(file).Note(FromUtime(6), 2, "ordered", {{"message", {{"type", "stop"}}}});
  const auto lines = Lines(file);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].dump(), R"({"utime":5,"client":1,"what":"joined","role":"driver"})");
  EXPECT_EQ(lines[1]["message"]["type"], "stop");
}

TEST(AuditLog, WhatPeopleSentCannotBreakALine) {
  const TemporaryFolder folder;
  AuditLog dut(folder / "audit.jsonl");
  dut.Note({}, 1, "cut off", {{"reason", "a\nb\xff\"}"}});
  EXPECT_EQ(Lines(folder / "audit.jsonl").size(), 1u);
}

TEST(AuditLog, AFullFileMakesRoomForTheNext) {
  const TemporaryFolder folder;
  const std::string file = folder / "audit.jsonl";
  std::ofstream(file) << std::string(AuditLog::kMostBytes - 10, ' ');
  AuditLog dut(file);
  dut.Note({}, 1, "joined");
  dut.Note({}, 1, "left");
  EXPECT_EQ(std::filesystem::file_size(file + ".1"), AuditLog::kMostBytes - 10);
  EXPECT_EQ(Lines(file).size(), 2u);
}

TEST(AuditLog, NoFileNoLineAndABadOneASentence) {
  AuditLog none("");
  none.Note({}, 1, "joined");
  EXPECT_EQ(none.failed(), 0u);
  EXPECT_THAT(ThrownReason([] { AuditLog("/nowhere/audit.jsonl"); }),
              HasSubstr("audit_file: /nowhere/audit.jsonl"));
  AuditLog full("/dev/full");
  full.Note({}, 1, "joined");
  full.Note({}, 1, "left");
  EXPECT_EQ(full.failed(), 2u) << "counted, and no end";
}

}  // namespace
}  // namespace priamos::console
