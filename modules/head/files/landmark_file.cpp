#include "head/files/landmark_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "common/config.hpp"
#include "head/core/bodies/cao.hpp"
#include "head/core/bodies/triangle_body.hpp"
#include "head/files/mesh_file.hpp"
#include "head/files/model_text.hpp"

namespace priamos::head {
namespace {

struct PointEntry {
  std::vector<double> at_m;

  void Describe(Archive& a) {
    a.Numbers("at_m", at_m, {"m", -100, 100, "landmark frame: x, y, z"});
    if (at_m.size() != 3) a.Refuse("at_m", "three coordinates");
  }
};

struct CornersEntry {
  std::vector<double> points;

  void Describe(Archive& a) {
    a.Numbers("points", points,
              {"-", 0, 100000, "numbers of points, from 0; faces counter-clockwise from outside"});
    for (const double p : points)
      if (p != std::floor(p)) a.Refuse("points", "whole numbers");
    if (points.size() < 2) a.Refuse("points", "two points of a line, or three and more of a face");
  }
  std::vector<int> indices() const { return {points.begin(), points.end()}; }
};

struct FaceEntry : CornersEntry {
  double grey = 0;

  void Describe(Archive& a) {
    CornersEntry::Describe(a);
    a.Number("grey", grey, {"-", 0, 255, "how bright it is beside the other faces; 0: not known"});
  }
};

struct PolyhedronFile {
  std::vector<PointEntry> points;
  std::vector<FaceEntry> faces;
  std::vector<CornersEntry> lines;

  void Describe(Archive& a) {
    a.List("points", points, "corners of the body");
    a.List("faces", faces, "flat faces");
    a.List("lines", lines, "edges that belong to no face");
    for (const CornersEntry& line : lines)
      if (line.points.size() != 2) a.Refuse("lines", "two points each");
  }
};

Outcome<std::string> ReadCao(const std::string& path) {
  return ReadText(path, "a model", 16);
}

Polyhedron LoadToml(const std::string& file) {
  const auto read = LoadConfig<PolyhedronFile>(file);
  Polyhedron body;
  for (const PointEntry& p : read.points) body.points.emplace_back(p.at_m[0], p.at_m[1], p.at_m[2]);
  for (const FaceEntry& face : read.faces) {
    body.faces.push_back(face.indices());
    body.greys.push_back(face.grey);
  }
  for (const CornersEntry& line : read.lines) body.lines.push_back({line.indices()[0], line.indices()[1]});
  if (const auto refusal = CheckPolyhedron(body))
    throw std::runtime_error(fmt::format("{}: {}", file, refusal->reason));
  return body;
}

BodyFile LoadCao(const std::string& file) {
  BodyFile loaded{{}, {file}};
  const auto text = ReadCao(file);
  if (!text) throw std::runtime_error(text.reason());
  auto body = ParseCao(file, *text, [&](const std::string& other) {
    loaded.files.push_back(other);
    return ReadCao(other);
  });
  if (!body) throw std::runtime_error(body.reason());
  loaded.body = std::move(*body);
  return loaded;
}

Polyhedron LoadMeshBody(const std::string& file) {
  auto body = BodyOfTriangles(LoadMesh(file));
  if (!body) throw std::runtime_error(fmt::format("{}: {}", file, body.reason()));
  return std::move(*body);
}

BodyFile LoadAnyBody(const std::string& file) {
  const std::string kind = ExtensionOf(file);
  if (kind == ".toml") return {LoadToml(file), {file}};
  if (kind == ".cao") return LoadCao(file);
  if (kind == ".obj" || kind == ".stl") return {LoadMeshBody(file), {file}};
  throw std::runtime_error(fmt::format("{}: expected a landmark model, .toml, .cao, .obj or .stl", file));
}

}  // namespace

BodyFile LoadBody(const std::string& file, double scale) {
  BodyFile loaded = LoadAnyBody(file);
  for (Eigen::Vector3d& point : loaded.body.points) point *= scale;
  return loaded;
}

Polyhedron LoadPolyhedron(const std::string& file, double scale) {
  return LoadBody(file, scale).body;
}

}  // namespace priamos::head
