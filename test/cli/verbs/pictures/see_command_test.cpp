#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::StartsWith;

class SeeCommand : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

/// A grey picture with a white rectangle, as PGM.
std::string RectanglePicture() {
  std::string pgm = "P5\n160 120\n255\n";
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) pgm += static_cast<char>(u > 40 && u < 120 && v > 30 && v < 90 ? 220 : 60);
  return pgm;
}

TEST_F(SeeCommand, DrawsBesideThePictureAndListsItsEdges) {
  const auto answer = Priamos({"see", Write("door.pgm", RectanglePicture()), "--json", "-"});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_TRUE(json::accept(answer.out)) << "nothing but JSON";
  EXPECT_NE(answer.err, "") << "what a person reads";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "door.pgm-edges.png") ||
              std::filesystem::exists(folder_ / "door-edges.png"));
}

TEST_F(SeeCommand, KeepsADrawingThatIsThere) {
  const std::string image = Write("door.pgm", RectanglePicture());
  EXPECT_EQ(Priamos({"see", image}).exit_code, 0);
  EXPECT_EQ(Priamos({"see", image}).exit_code, 2);
  EXPECT_EQ(Priamos({"see", image, "--force"}).exit_code, 0);
}

TEST_F(SeeCommand, RefusesWhatItCannotUse) {
  const std::string image = Write("door.pgm", RectanglePicture());
  const std::vector<std::vector<std::string>> lines{
      {"see"},
      {"see", folder_ / "none.png"},
      {"see", Write("text.png", "no picture")},
      {"see", image, "--landmark", "body.toml"},
      {"see", image, "--max-door-width", "0.4"},
      {"see", image, "--landmark", "body.toml", "--at", "1", "2", "3"}};
  for (const auto& line : lines) {
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << line.back();
    EXPECT_THAT(answer.err, StartsWith("priamos see: ")) << line.back();
    EXPECT_EQ(LinesOf(answer.err).size(), 1u) << answer.err;
  }
}

}  // namespace
}  // namespace priamos::cli
