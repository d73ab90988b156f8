#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kFocal_px = 800;

/// Corners of a lattice in space as a pinhole at (0, 0, -2) sees them: u = f x/z + 384, v = f y/z + 288.
std::string PointsOfAPinhole() {
  std::ostringstream lines;
  lines << std::setprecision(12) << "# X Y Z u v\n";
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = 0; k <= 2; ++k) {
        const double x = 0.2 * i, y = 0.15 * j, z = 0.3 * k, depth = z + 2;
        // A lens is never exact to the last digit: a wave of a hundredth of a pixel.
        lines << x << ' ' << y << ' ' << z << ' '
              << kFocal_px * x / depth + 384 + 0.01 * std::sin(7 * i + 3 * k) << ' '
              << kFocal_px * y / depth + 288 + 0.01 * std::cos(5 * j + 2 * k) << '\n';
      }
  return lines.str();
}

class CalibrateCommand : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

TEST_F(CalibrateCommand, PointsGiveTheCameraThatMadeThem) {
  const auto answer = Priamos({"calibrate", "--points", Write("points.txt", PointsOfAPinhole())});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const auto camera = json::parse(answer.out).at("cameras").at(0);
  EXPECT_NEAR(camera.at("K").at(0).at(0), kFocal_px, 5);
  EXPECT_NEAR(camera.at("K").at(1).at(2), 288, 5);
}

TEST_F(CalibrateCommand, WithAnOutputTheTerminalStaysEmptyAndTheFileIsWhole) {
  const std::string points = Write("points.txt", PointsOfAPinhole()), out = folder_ / "camera.json";
  const auto answer = Priamos({"calibrate", "--points", points, "--output", out});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out, "");
  EXPECT_TRUE(json::parse(FileContent(out)).contains("cameras"));
  EXPECT_FALSE(std::filesystem::exists(out + ".new")) << "it was renamed";
  EXPECT_EQ(json::parse(Priamos({"calibrate", "--points", points, "--output", "-"}).out),
            json::parse(FileContent(out)))
      << "- is standard output";
}

TEST_F(CalibrateCommand, AnOutputThatCannotBeWrittenIsNamed) {
  const auto answer = Priamos({"calibrate", "--points", Write("points.txt", PointsOfAPinhole()), "--output",
                               "/no/such/folder/camera.json"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("/no/such/folder/camera.json: expected a file that can be written"));
}

TEST_F(CalibrateCommand, ALineThatIsNoPointIsNamed) {
  const auto answer = Priamos({"calibrate", "--points", Write("points.txt", "1 2 3\n")});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(StartsWith("priamos calibrate: "), HasSubstr("points.txt:1: ")));
}

TEST_F(CalibrateCommand, OptionsThatDoNotGoTogetherAreRefused) {
  const std::string file = Write("a", "");
  const std::vector<std::vector<std::string>> lines{
      {"--points", file, "--photo", file}, {"--object", file}, {"--chessboard", "9", "6"}, {"--table", file}};
  for (auto line : lines) {
    line.insert(line.begin(), "calibrate");
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << line[1];
    EXPECT_THAT(answer.err, AllOf(StartsWith("priamos calibrate: "), HasSubstr(line[1])));
  }
}

TEST_F(CalibrateCommand, WhatATargetCannotBeIsRefused) {
  const std::string file = Write("a", "");
  const std::vector<std::vector<std::string>> lines{
      {"--dots", "2", "6"},          {"--dots", "6", "101"}, {"--spacing", "0"},        {"--radius", "-0.01"},
      {"--image-size", "63", "480"}, {"--dots", "6"},        {"--chessboard", "9", "2"}};
  for (const auto& options : lines) {
    std::vector<std::string> line{"calibrate", "--photo", file};
    line.insert(line.end(), options.begin(), options.end());
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << options[0];
    EXPECT_THAT(answer.err, HasSubstr("priamos calibrate: " + options[0] + ": expected"));
  }
}

TEST_F(CalibrateCommand, AnUnknownDeploymentOrWorldIsRefused) {
  const auto deployment = Priamos({"calibrate", "--deployment", "simm", "--output", folder_ / "t.yaml"});
  EXPECT_EQ(deployment.exit_code, 2);
  EXPECT_THAT(deployment.err, HasSubstr("\"sim\""));
  const auto world = Priamos({"calibrate", "--world", "worlds/none.toml", "--output", folder_ / "t.yaml"});
  EXPECT_EQ(world.exit_code, 2);
  EXPECT_THAT(world.err, HasSubstr("worlds/none.toml"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.yaml"));
}

}  // namespace
}  // namespace priamos::cli
