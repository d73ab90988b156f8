#include "head/files/landmark_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kPoints =
    "[[points]]\nat_m = [0, 0, 0]\n[[points]]\nat_m = [1.5, 0, 0]\n"
    "[[points]]\nat_m = [1.5, 0, 2]\n[[points]]\nat_m = [0, 0, 2]\n";

class LandmarkFileTest : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  Polyhedron Load(const std::string& text) const { return LoadPolyhedron(Write("body.toml", text)); }
  std::string ReasonOf(const std::string& text, const std::string& name = "body.toml") const {
    const std::string file = Write(name, text);
    return support::ThrownReason([&] { LoadPolyhedron(file); });
  }

  TemporaryFolder folder_;
};

TEST_F(LandmarkFileTest, ReadsPointsFacesAndLines) {
  const Polyhedron dut = Load(std::string(kPoints) +
                              "[[faces]]\npoints = [0, 1, 2, 3]\ngrey = 120\n[[lines]]\npoints = [0, 2]\n");
  ASSERT_EQ(dut.points.size(), 4u);
  EXPECT_EQ(dut.points[2], Eigen::Vector3d(1.5, 0, 2));
  EXPECT_THAT(dut.faces, ElementsAre(ElementsAre(0, 1, 2, 3)));
  EXPECT_THAT(dut.greys, ElementsAre(120));
  EXPECT_THAT(dut.lines, ElementsAre(ElementsAre(0, 2)));
}

TEST_F(LandmarkFileTest, AFaceWithoutAGreyIsOfUnknownBrightness) {
  const Polyhedron dut = Load(std::string(kPoints) +
                              "[[faces]]\npoints = [0, 1, 2]\n[[faces]]\npoints = [0, 2, 3]\ngrey = 80\n");
  EXPECT_THAT(dut.greys, ElementsAre(0, 80));
}

TEST_F(LandmarkFileTest, ABodyOfLinesNeedsNoFaces) {
  const Polyhedron dut = Load(std::string(kPoints) + "[[lines]]\npoints = [0, 3]\n");
  EXPECT_TRUE(dut.faces.empty());
  EXPECT_EQ(dut.lines.size(), 1u);
}

TEST_F(LandmarkFileTest, MistakesAreNamedWithFileAndLine) {
  EXPECT_THAT(ReasonOf("[[points]]\nat_m = [0, 0]\n"), HasSubstr("body.toml:2"));
  EXPECT_THAT(ReasonOf("[[points]]\nat_m = [0, 0, 0, 0]\n"), HasSubstr("three coordinates"));
  EXPECT_THAT(ReasonOf("[[points]]\nat_m = [0, 0, 101]\n"), HasSubstr("body.toml:2"));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[faces]]\npoints = [0, 1, 1.5]\n"),
              HasSubstr("whole numbers"));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[faces]]\npoints = [0, -1, 2]\n"), HasSubstr("body.toml:10"));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[lines]]\npoints = [0]\n"),
              HasSubstr("two points of a line"));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[lines]]\npoints = [0, 1, 2]\n"),
              HasSubstr("two points each"));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[faces]]\npoints = [0, 1, 2]\ngrey = 256\n"),
              HasSubstr("body.toml:11"));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "colour = 3\n"), HasSubstr("colour"));
}

TEST_F(LandmarkFileTest, WhatIsNoBodyIsRefusedWithTheFile) {
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[faces]]\npoints = [0, 1, 4]\n"), HasSubstr("body.toml: "));
  EXPECT_THAT(ReasonOf(std::string(kPoints) + "[[faces]]\npoints = [0, 1]\n"), HasSubstr("body.toml: "));
  EXPECT_THAT(ReasonOf(""), HasSubstr("body.toml: "));
  EXPECT_THAT(
      ReasonOf(std::string(kPoints) + "[[points]]\nat_m = [0.7, 0.5, 1]\n[[faces]]\npoints = [0, 1, 2, 4]\n"),
      HasSubstr("body.toml: "))
      << "not flat";
}

TEST_F(LandmarkFileTest, ReadsCaoAndWhatItLoadsFromBesideIt) {
  Write("parts/b.cao", "V1\n3\n0 0 0\n1 0 0\n0 1 0\n0\n0\n1\n3 0 1 2\n0\n0\n");
  const std::string file = Write("a.cao", "V1\nload(\"parts/b.cao\")\n0\n0\n0\n0\n0\n0\n");
  const Polyhedron dut = LoadPolyhedron(file);
  EXPECT_EQ(dut.points.size(), 3u);
  EXPECT_THAT(dut.faces, ElementsAre(ElementsAre(0, 1, 2)));
}

TEST_F(LandmarkFileTest, MistakesInCaoAreNamedWithFileAndLine) {
  EXPECT_THAT(ReasonOf("V2\n", "a.cao"), HasSubstr("a.cao:1: expected V1"));
  EXPECT_THAT(ReasonOf("V1\nload(\"none.cao\")\n0\n0\n0\n0\n0\n0\n", "a.cao"),
              HasSubstr("none.cao: expected a model, got none"));
}

TEST_F(LandmarkFileTest, AFileThatIsNotThereIsNamed) {
  for (const char* name : {"none.toml", "none.cao"}) {
    const std::string file = folder_ / name;
    EXPECT_THAT(support::ThrownReason([&] { LoadPolyhedron(file); }), HasSubstr(file)) << name;
  }
}

TEST_F(LandmarkFileTest, AnotherKindOfFileIsRefused) {
  EXPECT_THAT(ReasonOf("solid", "body.ply"),
              HasSubstr("body.ply: expected a landmark model, .toml, .cao, .obj or .stl"));
  EXPECT_THAT(ReasonOf(kPoints, "body"), HasSubstr("expected a landmark model, .toml, .cao, .obj or .stl"));
}

}  // namespace
}  // namespace priamos::head
