#include <gmock/gmock.h>

#include <fstream>
#include <regex>

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
    {"modules/common/body_size.hpp",
     R"(\b0\.95, 0\.78\b|\b(length|width|height)_m( = |\{)(0\.95|0\.78|1\.35|1\.40?)\b|\bhalf_(width|length)_m( = |\{)(0\.39|0\.475)\b|\bkBody\w*( = |\{)0\.(78|95)\b)"},
    {"modules/common/image_size.hpp", R"(\b768\b.*\b576\b|\b(383\.5|384), *(287\.5|288)\b)"},
    {"modules/common/sonar_ring.hpp", R"(\bkSonars = |\bkSonarM(in|ax)_m = )"},
    {"modules/common/braking_law.hpp", R"(/ \(2 \* deceleration|sqrt\(.*2 \* a\b)"},
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

}  // namespace
}  // namespace priamos
