#include "world/core/render/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace priamos::world {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCell_m = 0.6;  // grid on which light is computed, in the middle of a face ...
constexpr double kRim_m = 0.2;   // ... and near its rim, where corners are darker
constexpr double kInset_m = 0.08;
/// So near to a border light is computed where something thin beside it, such as a frame, shades the face.
constexpr std::array kContact_m{0.003, 0.008, 0.016, 0.03, kInset_m};
/// A border is shaded when it lacks this share of the light that is kInset_m away from it.
constexpr double kShade = 0.05;
constexpr double kLook_m = 0.05;      ///< along a border it is looked at so often
constexpr float kBlackLight = 0.03F;  // of the reference body ...
constexpr float kDiscLight = 0.08F;   // ... and its discs, but for the lamp beside the lens
constexpr int kDiscCorners = 96;

/// A rectangle in space: `origin` + a * `along` + b * `up`, a and b in 0..1; outside is along x up.
struct Face {
  Vector3d origin, along, up;
  double u0, v0, u1, v1;  ///< texture coordinates at origin and at the far corner
  int layer;
};

/// Coordinate of the face's beginning along one of its sides.
double Start(const Vector3d& origin, const Vector3d& side) {
  return origin.dot(side.normalized());
}

double LightAt(const Face& face, double a, double b, const Lighting& lighting) {
  const Vector3d normal = face.along.cross(face.up).normalized();
  return lighting.At(face.origin + a * face.along + b * face.up + 0.002 * normal, normal);
}

/// One side of a face; places along it are shares of its length.
struct Side {
  double start = 0, length_m = 0;
  bool dark_begin = false, dark_end = false;  ///< something thin shades the border at its beginning, its end
  std::vector<double> steps{};                ///< where what shades the other side's borders begins or ends

  double Share(double distance_m) const { return std::min(0.3, distance_m / length_m); }
  /// Where light is computed for a place: off a border, if nothing thin shades that.
  double Lit(double at) const {
    return std::clamp(at, Share(dark_begin ? kContact_m[0] : kInset_m),
                      1 - Share(dark_end ? kContact_m[0] : kInset_m));
  }
};

/// The place between two of different shade where it changes: one just before it and one just behind.
template <typename IsDark>
std::pair<double, double> StepBetween(double from, double to, const IsDark& is_dark) {
  constexpr int kHalvings = 3;
  const bool dark = is_dark(from);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (from + to) / 2;
    (is_dark(middle) == dark ? from : to) = middle;
  }
  return {from, to};
}

/// Whether something thin shades a border anywhere; `along` learns where that begins and ends.
template <typename IsDark>
bool FindShade(const IsDark& is_dark, Side& along) {
  const int n = std::max(3, static_cast<int>(along.length_m / kLook_m));
  bool any = false, last = false;
  for (int i = 0; i < n; ++i) {
    const double at = (i + 0.5) / n;
    const bool dark = is_dark(at);
    any = any || dark;
    if (i > 0 && dark != last) {
      const auto [before, behind] = StepBetween(at - 1.0 / n, at, is_dark);
      along.steps.insert(along.steps.end(), {before, behind});
    }
    last = dark;
  }
  return any;
}

/// Where along a side light is computed, 0..1: at its ends, near them, and at multiples of kCell_m of a
/// coordinate that is `start` at its beginning, so that faces in one plane agree about the light where they
/// meet.
std::vector<double> Grid(const Side& side) {
  const double length_m = side.length_m;
  std::vector<double> lines{0, length_m};
  const auto add = [&](double line) {
    const auto close = [line](double other) { return std::abs(line - other) < kRim_m / 2; };
    if (line > 0 && line < length_m && std::none_of(lines.begin(), lines.end(), close)) lines.push_back(line);
  };
  if (length_m > 3 * kRim_m) {
    add(kRim_m);
    add(length_m - kRim_m);
  }
  for (int i = static_cast<int>(std::ceil(side.start / kCell_m)); i * kCell_m < side.start + length_m; ++i)
    add(i * kCell_m - side.start);
  for (const double contact_m : kContact_m) {
    if (side.dark_begin) lines.push_back(side.Share(contact_m) * length_m);
    if (side.dark_end) lines.push_back((1 - side.Share(contact_m)) * length_m);
  }
  for (const double step : side.steps) lines.push_back(step * length_m);
  std::sort(lines.begin(), lines.end());
  for (double& line : lines) line /= length_m;
  return lines;
}

/// Both sides of a face, with what shades their borders.
std::pair<Side, Side> SidesOf(const Face& face, const Lighting& lighting) {
  Side a{Start(face.origin, face.along), face.along.norm()}, b{Start(face.origin, face.up), face.up.norm()};
  const auto look = [](Side& side, Side& along, const auto& light) {
    const double border = side.Share(kContact_m[0]), beside = side.Share(kInset_m);
    side.dark_begin =
        FindShade([&](double at) { return light(border, at) < (1 - kShade) * light(beside, at); }, along);
    side.dark_end = FindShade(
        [&](double at) { return light(1 - border, at) < (1 - kShade) * light(1 - beside, at); }, along);
  };
  if (std::min(a.length_m, b.length_m) < 3 * kRim_m) return {a, b};
  look(a, b, [&](double at, double along) { return LightAt(face, at, along, lighting); });
  look(b, a, [&](double at, double along) { return LightAt(face, along, at, lighting); });
  return {a, b};
}

void AppendFace(const Face& face, const Lighting& lighting, double most_light, Mesh& mesh) {
  const auto [along, up] = SidesOf(face, lighting);
  const std::vector<double> columns = Grid(along), rows = Grid(up);
  std::vector<MeshVertex> grid;
  for (const double b : rows) {
    for (const double a : columns) {
      const Vector3d p = face.origin + a * face.along + b * face.up;
      const double light = std::min(LightAt(face, along.Lit(a), up.Lit(b), lighting) / most_light, 1.0);
      grid.push_back({float(p.x()), float(p.y()), float(p.z()), float(face.u0 + a * (face.u1 - face.u0)),
                      float(face.v0 + b * (face.v1 - face.v0)), float(face.layer), float(light), 0, 0});
    }
  }
  for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const std::size_t k = j * columns.size() + i, above = k + columns.size();
      mesh.push_back({grid[k], grid[k + 1], grid[above + 1]});
      mesh.push_back({grid[k], grid[above + 1], grid[above]});
    }
  }
}

struct Sides {
  std::array<Face, 6> faces;  ///< -x, +x, -y, +y, bottom, top
};

/// Upright box about the frame's z axis.
Sides BoxFaces(const Eigen::Isometry3d& map_from_box, const Vector3d& low, const Vector3d& high) {
  const Vector3d s = high - low;
  const Vector3d x = map_from_box.linear() * Vector3d(s.x(), 0, 0);
  const Vector3d y = map_from_box.linear() * Vector3d(0, s.y(), 0);
  const Vector3d z = map_from_box.linear() * Vector3d(0, 0, s.z());
  const Vector3d o = map_from_box * low;
  return {{Face{o + y, -y, z, 0, 0, 0, 0, 0}, Face{o + x, y, z, 0, 0, 0, 0, 0}, Face{o, x, z, 0, 0, 0, 0, 0},
           Face{o + x + y, -x, z, 0, 0, 0, 0, 0}, Face{o + y, x, -y, 0, 0, 0, 0, 0},
           Face{o + z, x, y, 0, 0, 0, 0, 0}}};
}

/// The picture's first row is at the top.
void Hang(Face& face, int layer, bool mirrored) {
  face.u0 = mirrored ? 1 : 0;
  face.u1 = 1 - face.u0;
  face.v0 = 1;
  face.v1 = 0;
  face.layer = layer;
}

/// Coverings continue from solid to solid in one plane.
void Cover(Face& face, const Surface& surface) {
  face.u0 = Start(face.origin, face.along) / surface.tile_m;
  face.v0 = Start(face.origin, face.up) / surface.tile_m;
  face.u1 = face.u0 + face.along.norm() / surface.tile_m;
  face.v1 = face.v0 + face.up.norm() / surface.tile_m;
  face.layer = surface.picture ? surface.edge_layer : surface.layer;
}

/// A level piece of floor, `z` high.
void AppendLevel(const FloorPiece& piece, double z, const Surface& covering, const Lighting& lighting,
                 double most_light, Mesh& mesh) {
  const Vector2d size = piece.high - piece.low;
  Face face{{piece.low.x(), piece.low.y(), z}, {size.x(), 0, 0}, {0, size.y(), 0}, 0, 0, 0, 0, 0};
  Cover(face, covering);
  AppendFace(face, lighting, most_light, mesh);
}

/// Its bottom, and its sides seen from within.
void AppendHole(const HolePlan& hole, const Surface& covering, const Lighting& lighting, double most_light,
                Mesh& mesh) {
  const Vector2d half(hole.length_m / 2, hole.width_m / 2), middle(hole.x_m, hole.y_m);
  AppendLevel({middle - half, middle + half}, -hole.depth_m, covering, lighting, most_light, mesh);
  Eigen::Isometry3d map_from_hole(Eigen::Translation3d(hole.x_m, hole.y_m, 0));
  const Sides sides = BoxFaces(map_from_hole, {-half.x(), -half.y(), -hole.depth_m}, {half.x(), half.y(), 0});
  for (std::size_t i = 0; i < 4; ++i) {
    Face face = sides.faces[i];
    face.origin += face.along;
    face.along = -face.along;
    Cover(face, covering);
    AppendFace(face, lighting, most_light, mesh);
  }
}

}  // namespace

void AppendSolid(const Solid& solid, const Surface& surface, const Lighting& lighting, double most_light,
                 Mesh& mesh) {
  Eigen::Isometry3d map_from_box(Eigen::Translation3d(solid.map_from_solid.x, solid.map_from_solid.y, 0));
  map_from_box.rotate(Eigen::AngleAxisd(solid.map_from_solid.yaw, Vector3d::UnitZ()));
  const Vector3d half(solid.size_m.x() / 2, solid.size_m.y() / 2, 0);
  Sides sides =
      BoxFaces(map_from_box, -half + Vector3d(0, 0, solid.z_min_m), half + Vector3d(0, 0, solid.z_max_m));
  const bool thin_in_x = solid.size_m.x() <= solid.size_m.y();
  for (std::size_t i = 0; i < sides.faces.size(); ++i) {
    const bool front = surface.picture && (thin_in_x ? i < 2 : i == 2 || i == 3);
    if (front)
      Hang(sides.faces[i], surface.layer, surface.handed && i % 2 == 1);
    else
      Cover(sides.faces[i], surface);
    AppendFace(sides.faces[i], lighting, most_light, mesh);
  }
}

void AppendRoom(const SceneConfig& config, const Textures& textures, const Lighting& lighting,
                double most_light, Mesh& mesh) {
  const Surface covering = textures.Find(config.floor, "floor");
  const FloorPiece whole{{config.x_min_m, config.y_min_m}, {config.x_max_m, config.y_max_m}};
  for (const FloorPiece& piece : FloorAround(config.holes, whole))
    AppendLevel(piece, 0, covering, lighting, most_light, mesh);
  for (const HolePlan& hole : config.holes) AppendHole(hole, covering, lighting, most_light, mesh);
  const Vector3d x(config.x_max_m - config.x_min_m, 0, 0), y(0, config.y_max_m - config.y_min_m, 0);
  const Vector3d corner(config.x_min_m, config.y_min_m, 0);
  Face ceiling{corner + y + Vector3d(0, 0, config.ceiling_m), x, -y, 0, 0, 0, 0, 0};
  Cover(ceiling, textures.Find("ceiling", "ceiling"));
  AppendFace(ceiling, lighting, most_light, mesh);
}

void AppendReference(const PlacedReference& reference, Mesh& mesh) {
  const auto vertex = [](const Vector3d& p, float light, float retro) {
    return MeshVertex{float(p.x()), float(p.y()), float(p.z()), 0, 0, 0, light, retro, 0};
  };
  for (const ReferenceBlock& block : reference.object.blocks) {
    const Vector3d half = (block.size_m / 2 - Vector3d::Constant(kDiscThickness_m)).cwiseMax(1e-4);
    for (const Face& f :
         BoxFaces(reference.map_from_object, block.centre_m - half, block.centre_m + half).faces) {
      const auto corner = [&](int a, int b) {
        return vertex(f.origin + a * f.along + b * f.up, kBlackLight, 0);
      };
      mesh.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
      mesh.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
  }
  // A polygon with the circle's area.
  const double step = 2 * kPi / kDiscCorners, grow = std::sqrt(step / std::sin(step));
  for (const ReferenceDisc& disc : reference.object.discs) {
    const Vector3d n = disc.normal;
    const Vector3d a = (std::abs(n.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX()).cross(n).normalized();
    const Vector3d b = n.cross(a);
    const auto corner = [&](int i) {
      const Vector3d rim =
          disc.centre_m + disc.radius_m * grow * (std::cos(i * step) * a + std::sin(i * step) * b);
      return vertex(reference.map_from_object * rim, kDiscLight, 1);
    };
    const MeshVertex centre = vertex(reference.map_from_object * disc.centre_m, kDiscLight, 1);
    for (int i = 0; i < kDiscCorners; ++i) mesh.push_back({centre, corner(i), corner(i + 1)});
  }
}

}  // namespace priamos::world
