#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "common/ground_plan.hpp"
#include "common/robot/body_size.hpp"
#include "common/sonar_ring.hpp"
#include "test/support/project_files.hpp"

// What the drawing and the data sheets say of the robot is written in one header each; everything else takes
// its default from there. Tests may repeat a number, because they judge it.

namespace priamos {
namespace {

namespace fs = std::filesystem;

struct Fact {
  std::string home, pattern;
};

const std::vector<Fact> kFacts{
    {"modules/common/robot/body_size.hpp",
     R"(\b0\.95, 0\.78\b|\b(length|width|height)_m( = |\{)(0\.95|0\.78|1\.35|1\.40?)\b|\bhalf_(width|length)_m( = |\{)(0\.39|0\.475)\b|\bkBody\w*( = |\{)0\.(78|95)\b)"},
    {"modules/common/image_size.hpp", R"(\b768\b.*\b576\b|\b(383\.5|384), *(287\.5|288)\b)"},
    {"modules/common/sonar_ring.hpp", R"(\bkSonars = |\bkSonarM(in|ax)_m = )"},
    {"modules/common/robot/braking_law.hpp", R"(/ \(2 \* deceleration|sqrt\(.*2 \* a\b)"},
    {"modules/common/sonar_ring.cpp", R"(^Pose2 BaseFromSonar\(.*\{$)"},
};

/// "file:line" of every line of the product's sources that matches.
std::vector<std::string> Places(const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> places;
  for (const fs::path& file : ProjectFiles()) {
    if (!file.string().starts_with("modules/") || (file.extension() != ".hpp" && file.extension() != ".cpp"))
      continue;
    std::ifstream in(fs::path(PRIAMOS_SOURCE_DIR) / file);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number)
      if (std::regex_search(line.substr(0, line.find("//")), expression))
        places.push_back(file.string() + ":" + std::to_string(number));
  }
  return places;
}

TEST(OneHome, OfEveryFactOfTheDrawnRobot) {
  for (const Fact& fact : kFacts) {
    const auto places = Places(fact.pattern);
    EXPECT_FALSE(places.empty()) << fact.home << ": expected " << fact.pattern;
    EXPECT_THAT(places, testing::Each(testing::StartsWith(fact.home + ":")));
  }
}

/// The number that `name` is in a Java source; NaN if it is none.
double JavaNumber(const std::string& source, const std::string& name) {
  std::smatch found;
  const std::regex expression("\\b" + name + R"( = ([0-9.]+)[,;])");
  return std::regex_search(source, found, expression) ? std::stod(found[1]) : NAN;
}

// Java cannot include a header.
TEST(OneHome, TheSpyDrawsTheSameRobot) {
  std::ifstream in(PRIAMOS_SOURCE_DIR "/modules/cli/spy/SonarRing.java");
  const std::string source{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(JavaNumber(source, "SENSORS"), kSonars);
  EXPECT_EQ(JavaNumber(source, "LENGTH_M"), kDrawnBody.length_m);
  EXPECT_EQ(JavaNumber(source, "WIDTH_M"), kDrawnBody.width_m);
  EXPECT_EQ(JavaNumber(source, "RANGE_M"), kSonarMax_m);
}

TEST(OneHome, TheMessagesCarryEveryLandmarkOfAMap) {
  for (const fs::path& file : ProjectFiles()) {
    if (file.extension() != ".lcm" || file.string().starts_with("test/")) continue;
    std::ifstream in(fs::path(PRIAMOS_SOURCE_DIR) / file);
    for (std::string line; std::getline(in, line);) {
      if (line.find(" landmark_id;") == std::string::npos) continue;
      EXPECT_THAT(line, testing::HasSubstr(fmt::format("@range 0,{} ", kLastLandmarkId))) << file;
    }
  }
}

}  // namespace
}  // namespace priamos
