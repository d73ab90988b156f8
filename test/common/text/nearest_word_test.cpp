#include "common/text/nearest_word.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace priamos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<std::string> kVerbs{"down", "doctor", "list",  "lockstep", "log",
                                      "logs", "status", "topic", "type",     "up"};

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(EditDistance("list", "list"), 0);
  EXPECT_EQ(EditDistance("lst", "list"), 1);
  EXPECT_EQ(EditDistance("liist", "list"), 1);
  EXPECT_EQ(EditDistance("POZE", "POSE"), 1);
  EXPECT_EQ(EditDistance("tpoic", "topic"), 1) << "a swap is one slip of the fingers";
  EXPECT_EQ(EditDistance("", "list"), 4);
  EXPECT_EQ(EditDistance("abcd", "wxyz"), 4);
}

TEST(EditDistance, DoesNotCareForCase) {
  EXPECT_EQ(EditDistance("pose", "POSE"), 0);
}

RC_GTEST_PROP(EditDistance, IsSymmetricAndAtMostTheLongerLength,
              (const std::string& a, const std::string& b)) {
  RC_ASSERT(EditDistance(a, b) == EditDistance(b, a));
  RC_ASSERT(EditDistance(a, b) <= static_cast<int>(std::max(a.size(), b.size())));
  RC_ASSERT(EditDistance(a, a) == 0);
}

TEST(NearestWords, FindsWhatASlipMeant) {
  EXPECT_THAT(NearestWords("stats", kVerbs), ElementsAre("status"));
  EXPECT_THAT(NearestWords("tpoic", kVerbs), ElementsAre("topic"));
  EXPECT_THAT(NearestWords("lst", kVerbs), ElementsAre("list"));
  EXPECT_THAT(NearestWords("max_sped_m_s", std::vector<std::string>{"max_speed_m_s", "max_turn_rad_s"}),
              ElementsAre("max_speed_m_s"));
}

TEST(NearestWords, AWordThatBeginsSoWinsAndTheShortestOfThem) {
  EXPECT_THAT(NearestWords("lo", kVerbs), ElementsAre("log"));
  EXPECT_THAT(NearestWords("lock", kVerbs), ElementsAre("lockstep")) << "not log, which is as near";
}

TEST(NearestWords, AForgottenUnderscoreIsFoundInAShortWord) {
  EXPECT_THAT(NearestWords("xm", std::vector<std::string>{"x_m", "y_m", "yaw_rad"}), ElementsAre("x_m"));
}

TEST(NearestWords, NamesAllThatAreEquallyNear) {
  EXPECT_THAT(NearestWords("lxgs", std::vector<std::string>{"lags", "logs", "status"}),
              ElementsAre("lags", "logs"));
}

TEST(NearestWords, NothingIsNearWhatIsFar) {
  EXPECT_THAT(NearestWords("elephant", kVerbs), IsEmpty());
  EXPECT_THAT(NearestWords("x", kVerbs), IsEmpty()) << "one letter may be anything";
  EXPECT_THAT(NearestWords("", kVerbs), IsEmpty());
}

TEST(NearestText, IsTheEndOfASentence) {
  EXPECT_EQ(NearestText("stats", kVerbs), "; nearest: \"status\"");
  EXPECT_EQ(NearestText("lxgs", std::vector<std::string>{"logs", "lags"}), "; nearest: \"lags\" or \"logs\"");
  EXPECT_EQ(NearestText("elephant", kVerbs), "");
}

}  // namespace
}  // namespace priamos
