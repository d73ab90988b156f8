#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "test/cli/priamos_answer.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

bool AnyBad(const json& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const json& f) { return f.at("verdict") == "BAD"; });
}

/// Whatever this machine lacks.
TEST(DoctorCommand, TheExitCodeIsOneWhenSomethingIsBad) {
  const auto answer = Priamos({"doctor", "--bus", "memq://", "--json"});
  EXPECT_EQ(answer.exit_code, AnyBad(json::parse(answer.out)) ? 1 : 0);
  EXPECT_EQ(answer.err, "");
}

TEST(DoctorCommand, WhatIsNotGoodComesWithACommand) {
  for (const json& finding : json::parse(Priamos({"doctor", "--bus", "memq://", "--json"}).out)) {
    const std::string verdict = finding.at("verdict");
    EXPECT_THAT((std::set<std::string>{"good", "note", "BAD"}), testing::Contains(verdict));
    EXPECT_EQ(finding.at("command").get<std::string>().empty(), verdict == "good") << finding;
    EXPECT_NE(finding.at("found"), "");
  }
}

TEST(DoctorCommand, ForAPersonEveryFindingHasALineAndEveryCommandAnother) {
  const auto findings = json::parse(Priamos({"doctor", "--bus", "memq://", "--json"}).out);
  const auto lines = LinesOf(Priamos({"doctor", "--bus", "memq://"}).out);
  const auto commands =
      std::count_if(findings.begin(), findings.end(), [](const json& f) { return f.at("command") != ""; });
  ASSERT_EQ(lines.size(), findings.size() + static_cast<std::size_t>(commands));
  EXPECT_THAT(lines[0], StartsWith("good  multicast route        there is one for memq://"))
      << "a bus inside one process needs none";
}

TEST(DoctorCommand, ABusThatIsNoneIsRefused) {
  const auto answer = Priamos({"doctor", "--bus", "ofboard"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("ofboard"));
}

}  // namespace
}  // namespace priamos::cli
