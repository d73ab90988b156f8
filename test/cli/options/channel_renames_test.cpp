#include "cli/options/channel_renames.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// "" when `selection` fits a log with A, B and POSE.
std::string Refusal(const bus::LogSelection& selection) {
  try {
    RequireRenamesFit(selection, {"A", "B", "POSE"}, "a.lcmlog");
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

bus::LogSelection Renaming(const std::vector<std::string>& pairs) {
  bus::LogSelection selection;
  selection.rename = ParseRenames(pairs);
  return selection;
}

TEST(ChannelRenames, APairHasTwoNamesThatLcmCanHave) {
  EXPECT_EQ(ParseRenames({"A=B", "C=" + std::string(63, 'd')}).size(), 2u);
  for (const std::string pair : {"A", "=B", "A=", "A=B\xc3\xbc", "A=B\t"})
    EXPECT_THROW(ParseRenames({pair}), std::runtime_error) << pair;
  EXPECT_THROW(ParseRenames({"A=" + std::string(64, 'b')}), std::runtime_error);
  EXPECT_THROW(ParseRenames({"A=B", "A=C"}), std::runtime_error);
}

TEST(ChannelRenames, AChannelThatTheLogLacksIsNamedWithTheNearest) {
  EXPECT_EQ(
      Refusal(Renaming({"POZE=P"})),
      "--rename POZE=P: expected a channel of a.lcmlog, got \"POZE\"; nearest: \"POSE\" (priamos log info "
      "lists all)");
}

TEST(ChannelRenames, TwoChannelsDoNotGetOneName) {
  EXPECT_THAT(Refusal(Renaming({"A=B"})), AllOf(HasSubstr("--rename A=B: "), HasSubstr("--without B")));
  EXPECT_THAT(Refusal(Renaming({"POSE=A"})), AllOf(HasSubstr("--rename POSE=A: "), HasSubstr("--without A")));
  EXPECT_THAT(Refusal(Renaming({"A=C", "B=C"})), HasSubstr("gets it too"));
}

TEST(ChannelRenames, WhatBecomesFreeMayBeTaken) {
  EXPECT_EQ(Refusal(Renaming({"A=B", "B=A"})), "");
  auto without = Renaming({"A=B"});
  without.without = {"B"};
  EXPECT_EQ(Refusal(without), "");
  auto only = Renaming({"A=B"});
  only.only = {"A"};
  EXPECT_EQ(Refusal(only), "");
}

}  // namespace
}  // namespace priamos::cli
