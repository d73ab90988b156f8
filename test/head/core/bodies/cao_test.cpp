#include "head/core/bodies/cao.hpp"

#include <gmock/gmock.h>

namespace priamos::head {
namespace {

using testing::HasSubstr;

Outcome<std::string> NoFile(const std::string& file) {
  return Refusal{file + ": cannot be read"};
}

Outcome<Polyhedron> Parse(const std::string& text) {
  return ParseCao("models/a.cao", text, NoFile);
}

constexpr const char* kTriangle = "V1\n# points\n3\n0 0 0 # one\n1 0 0\n0 1 0\n";

TEST(Cao, ReadsFacesOfPoints) {
  const auto dut = Parse(std::string(kTriangle) + "0\n0\n1\n3 0 1 2 name=floor\n0\n0\n");
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->faces.size(), 1u);
  EXPECT_EQ(dut->faces[0], (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(dut->points[1], Eigen::Vector3d(1, 0, 0));
}

TEST(Cao, FacesOfLinesHaveTheirCornersInOrderAndOtherLinesStay) {
  const auto dut = Parse(std::string(kTriangle) + "4\n0 1\n2 1\n2 0\n0 2\n1\n3 0 1 2\n0\n");
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->faces[0], (std::vector<int>{1, 2, 0}));
  EXPECT_EQ(dut->lines.size(), 1u);
}

TEST(Cao, LoadsOtherFilesFromItsOwnFolder) {
  const auto read = [](const std::string& file) -> Outcome<std::string> {
    if (file != "models/parts/b.cao") return Refusal{file + ": cannot be read"};
    return std::string(kTriangle) + "0\n0\n1\n3 0 1 2\n";
  };
  const auto dut =
      ParseCao("models/a.cao", "V1\nload(\"parts/b.cao\")\nload(\"parts/b.cao\")\n0\n0\n0\n0\n0\n0\n", read);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->points.size(), 6u);
  EXPECT_EQ(dut->faces[1], (std::vector<int>{3, 4, 5}));
}

TEST(Cao, EveryMistakeIsNamedWithItsLine) {
  EXPECT_THAT(Parse("").reason(), HasSubstr("models/a.cao:1: expected V1"));
  EXPECT_THAT(Parse("V2\n").reason(), HasSubstr("a.cao:1: expected V1, got \"V2\""));
  EXPECT_THAT(Parse("V1\n2\n0 0 0\n").reason(), HasSubstr("a.cao:3: expected a point, got the end"));
  EXPECT_THAT(Parse("V1\n1\n0 0 zero\n").reason(),
              HasSubstr("a.cao:3: expected a coordinate [m], got \"zero\""));
  EXPECT_THAT(Parse("V1\n1\n0 0 inf\n").reason(), HasSubstr("a.cao:3: expected a coordinate"));
  EXPECT_THAT(Parse("V1\n-1\n").reason(), HasSubstr("number of points (0 to 100000), got \"-1\""));
  EXPECT_THAT(Parse("V1\n99999999999999999999\n").reason(), HasSubstr("number of points"));
  EXPECT_THAT(Parse(std::string(kTriangle) + "0\n0\n1\n3 0 1 3\n").reason(),
              HasSubstr("a.cao:10: expected the number of a point (0 to 2), got 3"));
  EXPECT_THAT(Parse(std::string(kTriangle) + "0\n0\n1\n4 0 1 2\n").reason(),
              HasSubstr("a.cao:10: expected a face of 4 corners"));
  EXPECT_THAT(Parse(std::string(kTriangle) + "0\n0\n1\n4 0 1 2 1\n").reason(),
              HasSubstr("a.cao:10: expected the number of a point once in a face, got 1 twice"));
  EXPECT_THAT(Parse(std::string(kTriangle) + "2\n0 1\n1 2\n0\n0\n1\n0 1 2 0.5\n").reason(),
              HasSubstr("cylinders"));
  EXPECT_THAT(Parse("V1\nload(b.cao)\n").reason(), HasSubstr("a.cao:2: expected load(\"file.cao\")"));
  EXPECT_THAT(Parse("V1\nload(\"b.cao\")\n").reason(), HasSubstr("models/b.cao: cannot be read"));
  EXPECT_THAT(Parse("V1\n0\n0\n0\n0\n0\n0\n").reason(), HasSubstr("at least one face"));
}

TEST(Cao, AFileThatLoadsItselfEnds) {
  const std::string self = "V1\nload(\"a.cao\")\n0\n0\n0\n0\n";
  const auto read = [&](const std::string&) -> Outcome<std::string> { return self; };
  EXPECT_THAT(ParseCao("a.cao", self, read).reason(), HasSubstr("loads itself"));
}

}  // namespace
}  // namespace priamos::head
