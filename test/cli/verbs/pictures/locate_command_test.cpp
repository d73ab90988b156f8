#include <gmock/gmock.h>

#include <fstream>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(LocateCommand, RefusesWhatItCannotUse) {
  TemporaryFolder folder;
  std::ofstream(folder / "body.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder / "text.png") << "no picture";
  const std::string model = folder / "body.obj", image = folder / "text.png", camera = folder / "none.yaml";
  const std::vector<std::vector<std::string>> lines{
      {"locate"},
      {"locate", image},
      {"locate", image, "--cameras", camera, "--model", model},
      {"locate", image, "--cameras", camera, "--model", model, "--at", "1", "2", "3"},
      {"locate", image, "--cameras", camera, "--model", model, "--at", "0", "0", "1", "0", "0", "0"},
      {"locate", image, "--cameras", camera, "--model", camera, "--at", "0", "0", "1", "0", "0", "0"},
      {"locate", image, "--cameras", camera, "--model", model, "--at", "0", "0", "1", "0", "0", "0",
       "--prior", "0", "1"},
      {"locate", image, "--cameras", camera, "--model", model, "--at", "0", "0", "1", "0", "0", "0",
       "--scale", "0"}};
  for (const auto& line : lines) {
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << line.back();
    EXPECT_THAT(answer.err, StartsWith("priamos locate: ")) << line.back();
  }
}

TEST(LocateCommand, ItsHelpTellsHowToBegin) {
  const auto answer = Priamos({"locate", "--help"});
  EXPECT_EQ(answer.exit_code, 0);
  for (const char* option : {"--model", "--at", "--prior", "--motion", "--model-sigma", "--json"})
    EXPECT_THAT(answer.out, HasSubstr(option));
}

}  // namespace
}  // namespace priamos::cli
