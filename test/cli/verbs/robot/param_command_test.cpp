#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "test/cli/priamos_answer.hpp"

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kSim = PRIAMOS_SOURCE_DIR "/config/sim";
constexpr const char* kSpeedKey = "drive.follower.shape.max_speed_m_s";

TEST(ParamCommand, ListsWhatMayBeChangedWithTheFilesValues) {
  const auto answer = Priamos({"param", "list", "--deployment", kSim});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out,
              AllOf(HasSubstr(kSpeedKey), HasSubstr("0.6"), HasSubstr("0.05 to 1.5"),
                    HasSubstr("live, at most the file's"), HasSubstr("planner"), HasSubstr("head")));
  const auto lines = LinesOf(Priamos({"param", "list", "planner", "--deployment", kSim, "--json"}).out);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(nlohmann::json::parse(lines.front())["key"], "mission.speed_m_s");
  EXPECT_EQ(nlohmann::json::parse(lines.front())["value"], 0.3) << "that of config/sim/planner.toml";
}

TEST(ParamCommand, AKeyThatIsNotLiveSaysWhenItTakesEffect) {
  const auto answer = Priamos({"param", "set", "robot", "rate_hz", "20", "--bus", "memq://"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("rate_hz"), HasSubstr("takes effect at its next start")));
}

TEST(ParamCommand, AMistypedKeyIsAnsweredWithTheNearest) {
  const auto answer =
      Priamos({"param", "get", "robot", "drive.follower.shape.max_sped_m_s", "--bus", "memq://"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr(kSpeedKey));
}

TEST(ParamCommand, AValueOutOfRangeIsNotSent) {
  const std::map<std::string, std::string> sentences{{"7", "expected 0.05 to 1.5 [m/s], got 7"},
                                                     {"0.01", "expected 0.05 to 1.5 [m/s], got 0.01"},
                                                     {"nan", "expected a number"},
                                                     {"inf", "expected a number"}};
  for (const auto& [value, sentence] : sentences) {
    const auto answer = Priamos({"param", "set", "robot", kSpeedKey, value, "--bus", "memq://"});
    EXPECT_EQ(answer.exit_code, 2) << value;
    EXPECT_THAT(answer.err, HasSubstr(sentence)) << value;
  }
}

TEST(ParamCommand, AProcessWithoutParametersIsRefused) {
  EXPECT_EQ(Priamos({"param", "save", "teleop", "--bus", "memq://"}).exit_code, 2);
  EXPECT_EQ(Priamos({"param", "save", "--bus", "memq://"}).exit_code, 2);
}

}  // namespace
}  // namespace priamos::cli
