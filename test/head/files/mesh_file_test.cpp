#include "head/files/mesh_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdint>
#include <fstream>

#include "head/files/landmark_file.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using support::ThrownReason;
using testing::AllOf;
using testing::HasSubstr;

/// A box of 1 x 2 x 3, one square per side.
constexpr const char* kObj =
    "mtllib /etc/passwd\n"
    "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

class MeshFileTest : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

/// The triangles of the mesh as a binary STL file.
std::string BinaryStl(const TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0F);
    for (const int i : triangle)
      for (const double v : mesh.points[i]) put(static_cast<float>(v));
    put(std::uint16_t{0});
  }
  return bytes;
}

TEST_F(MeshFileTest, ABoxOfObjHasSixFacesInMetres) {
  const Polyhedron dut = LoadPolyhedron(Write("box.obj", kObj), 0.001);
  EXPECT_EQ(dut.faces.size(), 6u);
  ASSERT_EQ(dut.points.size(), 8u);
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : dut.points) largest = largest.cwiseMax(p);
  EXPECT_TRUE(largest.isApprox(Eigen::Vector3d(0.001, 0.002, 0.003), 1e-6));
}

TEST_F(MeshFileTest, TheSameBoxAsStl) {
  const TriangleMesh mesh = LoadMesh(Write("box.obj", kObj));
  ASSERT_EQ(mesh.triangles.size(), 12u);
  const Polyhedron dut = LoadPolyhedron(Write("box.STL", BinaryStl(mesh)));
  EXPECT_EQ(dut.faces.size(), 6u);
  EXPECT_EQ(dut.points.size(), 8u);
}

TEST_F(MeshFileTest, CommentsAndAByteOrderMarkAreNoNumbers) {
  std::string text = kObj;
  text.replace(text.find("v 1 2 0"), 7, "v 1 2 0 # a corner");
  text.replace(text.find("f 1 4 3 2"), 9, "f 1 4 3 2#the floor");
  EXPECT_EQ(LoadPolyhedron(Write("box.obj", "\xef\xbb\xbf" + text)).faces.size(), 6u);
}

TEST_F(MeshFileTest, OtherModelsAreScaledToo) {
  const std::string file = Write("line.toml",
                                 "points = [{ at_m = [0, 0, 0] }, { at_m = [2, 0, 0] }]\n"
                                 "lines = [{ points = [0, 1] }]\n");
  EXPECT_EQ(LoadPolyhedron(file, 0.5).points[1].x(), 1);
}

TEST_F(MeshFileTest, WhatIsNoMeshIsNamed) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.cao").c_str(), 0600), 0);
  EXPECT_THAT(ThrownReason([&] { LoadPolyhedron(folder_ / "pipe.cao"); }),
              HasSubstr("pipe.cao: expected a model, got a pipe"));
  EXPECT_THAT(ThrownReason([&] { LoadMesh(folder_ / "none.obj"); }),
              AllOf(HasSubstr("none.obj"), HasSubstr("expected a mesh")));
  EXPECT_THAT(ThrownReason([&] { LoadMesh("/dev/zero"); }), HasSubstr("/dev/zero: expected a mesh"));
  EXPECT_THAT(ThrownReason([&] { LoadMesh(Write("text.stl", "no mesh at all")); }), HasSubstr("text.stl"));
  EXPECT_THAT(ThrownReason([&] { LoadMesh(Write("empty.obj", "")); }), HasSubstr("empty.obj"));
  EXPECT_THAT(ThrownReason([&] { LoadMesh(Write("points.obj", "v 0 0 0\nv 1 0 0\n")); }),
              HasSubstr("points.obj"));
}

TEST_F(MeshFileTest, ALineThatIsNoneOfAMeshIsNamed) {
  const auto reason = [&](const char* name, const std::string& text) {
    const std::string file = Write(name, text);
    return ThrownReason([&] { LoadMesh(file); }).substr(file.size());
  };
  EXPECT_EQ(reason("a.obj", "v 0 0 0\nv 1 zz 0\n"), ":2: v: expected a number, got \"zz\"");
  EXPECT_EQ(reason("a.obj", "v 0 0\n"), ":1: v: expected 3 numbers, got 2");
  EXPECT_EQ(reason("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n"),
            ":3: v: expected a number, got \"nan\"");
  EXPECT_EQ(reason("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 9\n"),
            ":5: f: expected the number of one of 3 places, got \"9\"");
  EXPECT_EQ(reason("a.obj", "v 0 0 0\nf 1/1 1/2\n"), ":2: f: expected 3 corners or more, got 2");
  EXPECT_EQ(reason("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 x 0\nendsolid\n"),
            ":4: vertex: expected a number, got \"x\"");
}

TEST_F(MeshFileTest, LinesThatGoOnAndNumbersFromTheLastPlaceBackAreRead) {
  EXPECT_EQ(LoadMesh(Write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 \\\n-2 -1\n")).triangles.size(), 1u);
}

TEST_F(MeshFileTest, ADamagedMeshIsRefusedOrRead) {
  const std::string stl = BinaryStl(LoadMesh(Write("box.obj", kObj)));
  for (std::size_t length = 0; length < stl.size(); length += 37) {
    const std::string file = Write("cut.stl", stl.substr(0, length));
    try {
      LoadPolyhedron(file);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("cut.stl"));
    }
  }
}

}  // namespace
}  // namespace priamos::head
