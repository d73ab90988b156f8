#include "head/locate/image_names.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using support::ThrownReason;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> All(ImageNames dut) {
  std::vector<std::string> names;
  while (const auto next = dut.Next(1)) names.push_back(next->front());
  return names;
}

TEST(ImageNames, NumbersInNamesAreNumbers) {
  EXPECT_TRUE(ComesBefore("a2.png", "a10.png"));
  EXPECT_FALSE(ComesBefore("a10.png", "a2.png"));
  EXPECT_TRUE(ComesBefore("a02.png", "a10.png"));
  EXPECT_TRUE(ComesBefore("a.png", "b.png"));
  EXPECT_TRUE(ComesBefore("a1", "a1b"));
  EXPECT_NE(ComesBefore("a01.png", "a1.png"), ComesBefore("a1.png", "a01.png")) << "one of them is first";
  EXPECT_FALSE(ComesBefore("a1.png", "a1.png"));
}

TEST(ImageNames, AFolderStandsForItsImages) {
  TemporaryFolder folder;
  for (const char* name : {"f10.png", "f9.PNG", "notes.txt", "f1.jpg"}) std::ofstream(folder / name) << "x";
  std::istringstream none;
  EXPECT_THAT(All({{"first.png", folder.path()}, none}),
              ElementsAre("first.png", folder / "f1.jpg", folder / "f9.PNG", folder / "f10.png"));
}

TEST(ImageNames, AFolderWithoutImagesIsNamed) {
  TemporaryFolder folder;
  std::istringstream none;
  EXPECT_THAT(ThrownReason([&] { ImageNames({folder.path()}, none); }), HasSubstr(folder.path()));
}

TEST(ImageNames, LinesComeAsTheyAre) {
  std::istringstream lines("a b.png\n\nc.png");
  EXPECT_THAT(All({{"-", "last.png"}, lines}), ElementsAre("a b.png", "c.png", "last.png"));
}

TEST(ImageNames, ALineWithoutEndIsRefused) {
  std::istringstream lines("a.png\n" + std::string(5000, 'x'));
  ImageNames dut({"-"}, lines);
  EXPECT_THAT(*dut.Next(1), ElementsAre("a.png"));
  EXPECT_THAT(ThrownReason([&] { dut.Next(1); }), HasSubstr("at most 4096 bytes"));
}

TEST(ImageNames, MomentsAreWhole) {
  std::istringstream none;
  ImageNames dut({"l0.png", "r0.png", "l1.png"}, none);
  EXPECT_THAT(*dut.Next(2), ElementsAre("l0.png", "r0.png"));
  EXPECT_THAT(ThrownReason([&] { dut.Next(2); }), HasSubstr("expected 2 images of one moment, got 1"));
}

}  // namespace
}  // namespace priamos::head
