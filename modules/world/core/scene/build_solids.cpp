#include "world/core/scene/build_solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/archive.hpp"
#include "common/random.hpp"
#include "world/core/scene/built_doors.hpp"

namespace priamos::world {
namespace {

constexpr double kPosterThickness_m = 0.004;
/// A wall that the map ends so near to a door's frame goes on to it.
constexpr double kJoint_m = 0.15;

/// Part of a wall; distances along it from its `from_m`.
struct Piece {
  double begin_m, end_m;
};

struct WallLine {
  explicit WallLine(const WallPlan& wall)
      : length_m((wall.to() - wall.from()).norm()),
        map_from_line{wall.from_m[0], wall.from_m[1],
                      std::atan2(wall.to_m[1] - wall.from_m[1], wall.to_m[0] - wall.from_m[0])} {}

  /// Whether the door stands in the wall, or beside one of its ends within `beside_m`.
  bool Holds(const DoorPlan& door, const WallPlan& wall, double beside_m) const {
    const Pose2 in_wall = map_from_line.Inverse() * door.map_from_door();
    return std::abs(std::cos(in_wall.yaw)) < 0.5 && std::abs(in_wall.y) <= wall.thickness_m &&
           in_wall.x > -beside_m && in_wall.x < length_m + beside_m;
  }

  double length_m;
  Pose2 map_from_line;  ///< x along the wall from its `from_m`
};

double Reach(const DoorPlan& door) {
  return door.opening_width_m / 2 + door.frame_width_m;
}

class Builder {
 public:
  Builder(const GroundPlan& map, const WorldPlan& plan, std::uint64_t seed)
      : map_(map), plan_(plan), rng_(Rng::Stream(seed, "furniture")), doors_(BuiltDoors(map, plan, seed)) {}

  std::vector<Solid> Build() {
    for (const auto& wall : map_.walls) AddWall(wall);
    for (const auto& door : doors_) AddDoor(door);
    for (const auto& poster : plan_.posters) AddPoster(poster);
    for (const auto& box : plan_.boxes) AddBox(box);
    MakeNamesUnique();
    return std::move(solids_);
  }

 private:
  DoorWork WorkOf(const DoorPlan& door) const {
    for (const auto& work : plan_.doors)
      if (work.id == door.id) return work;
    return {};
  }
  WallLine LineOf(const WallPlan& wall) const;
  std::string MaterialOf(const WallPlan& wall) const;
  std::vector<Piece> PiecesBesideDoors(const WallPlan& wall);
  void AddWall(const WallPlan& wall);
  void AddSkirting(const WallPlan& wall, const Piece& piece);
  void AddDoor(const DoorPlan& door);
  void AddPoster(const PosterPlan& poster);
  void AddBox(const BoxPlan& box);
  void MakeNamesUnique();

  const GroundPlan& map_;
  const WorldPlan& plan_;
  Rng rng_;
  std::vector<DoorPlan> doors_;
  std::vector<Solid> solids_;
};

/// The line of the wall as it was built: where the plan has a door elsewhere, it has the wall around it
/// elsewhere, too.
WallLine Builder::LineOf(const WallPlan& wall) const {
  WallLine line(wall);
  for (std::size_t i = 0; i < doors_.size(); ++i) {
    const DoorPlan& planned = map_.doors[i];
    if (!line.Holds(planned, wall, Reach(planned) + kJoint_m)) continue;
    const Pose2 moved = planned.map_from_door().Inverse() * doors_[i].map_from_door();
    if (moved.x == 0 && moved.yaw == 0) continue;
    line.map_from_line = doors_[i].map_from_door() * Pose2{0, -moved.y, 0} *
                         planned.map_from_door().Inverse() * line.map_from_line;
    break;
  }
  return line;
}

std::string Builder::MaterialOf(const WallPlan& wall) const {
  for (const auto& surface : plan_.surfaces)
    if (surface.wall == wall.name) return surface.material;
  return plan_.wall_material;
}

/// A map may draw a wall through the door or end it at the opening: either way it ends at the frame.
std::vector<Piece> Builder::PiecesBesideDoors(const WallPlan& wall) {
  const WallLine line = LineOf(wall);
  std::vector<Piece> pieces{{0, line.length_m}};
  for (const auto& door : doors_) {
    if (!line.Holds(door, wall, Reach(door) + kJoint_m)) continue;
    const double middle_m = (line.map_from_line.Inverse() * door.map_from_door()).x;
    const Piece frame{middle_m - Reach(door), middle_m + Reach(door)};
    std::vector<Piece> cut;
    for (const auto& piece : pieces) {
      const double end_m = piece.end_m > frame.begin_m - kJoint_m ? frame.begin_m : piece.end_m;
      const double begin_m = piece.begin_m < frame.end_m + kJoint_m ? frame.end_m : piece.begin_m;
      cut.push_back({piece.begin_m, end_m});
      cut.push_back({begin_m, piece.end_m});
    }
    pieces = cut;
  }
  std::erase_if(pieces, [](const Piece& piece) { return piece.end_m - piece.begin_m < 0.001; });
  return pieces;
}

void Builder::AddWall(const WallPlan& wall) {
  const WallLine line = LineOf(wall);
  for (const auto& piece : PiecesBesideDoors(wall)) {
    const double length = piece.end_m - piece.begin_m;
    solids_.push_back({"wall " + wall.name,
                       line.map_from_line * Pose2{piece.begin_m + length / 2, 0, 0},
                       {length, wall.thickness_m},
                       0,
                       plan_.light.ceiling_m,
                       MaterialOf(wall)});
    if (plan_.skirting.height_m > 0) AddSkirting(wall, piece);
  }
}

void Builder::AddSkirting(const WallPlan& wall, const Piece& piece) {
  const WallLine line = LineOf(wall);
  const double length = piece.end_m - piece.begin_m;
  for (const double side : {1.0, -1.0}) {
    const double beside = side * (wall.thickness_m + plan_.skirting.thickness_m) / 2;
    solids_.push_back({"skirting " + wall.name,
                       line.map_from_line * Pose2{piece.begin_m + length / 2, beside, 0},
                       {length, plan_.skirting.thickness_m},
                       0,
                       plan_.skirting.height_m,
                       plan_.skirting.material});
  }
}

void Builder::AddDoor(const DoorPlan& door) {
  const DoorWork work = WorkOf(door);
  const double open_deg = std::clamp(work.open_deg + rng_.Uniform(-1, 1) * work.open_spread_deg, 0.0, 175.0);
  auto parts = DoorSolids(door, work, open_deg);
  const bool listed =
      std::any_of(plan_.doors.begin(), plan_.doors.end(), [&](const DoorWork& w) { return w.id == door.id; });
  if (!listed) std::erase_if(parts, [](const Solid& part) { return part.material == "door_leaf"; });
  solids_.insert(solids_.end(), parts.begin(), parts.end());

  // The wall goes on above the frame, in the material of a wall that the door is in.
  const double outer = Reach(door);
  const double top = door.opening_height_m + door.frame_width_m;
  const WallPlan* host = nullptr;
  for (const auto& wall : map_.walls)
    if (LineOf(wall).Holds(door, wall, outer + kJoint_m)) host = &wall;
  if (!host)
    throw ConfigError(
        fmt::format("{}: doors: expected door \"{}\" to stand in or between walls", plan_.map, door.name));
  if (plan_.light.ceiling_m > top)
    solids_.push_back({door.name + ": wall above",
                       door.map_from_door(),
                       {host->thickness_m, 2 * outer},
                       top,
                       plan_.light.ceiling_m,
                       MaterialOf(*host)});
}

void Builder::AddPoster(const PosterPlan& poster) {
  const auto hung = std::find_if(map_.walls.begin(), map_.walls.end(),
                                 [&](const WallPlan& w) { return w.name == poster.wall; });
  if (hung == map_.walls.end()) return;
  const WallPlan& wall = *hung;
  const double side = poster.face == "left" ? 1 : -1;
  // Front of the poster is its +y side, whichever face of the wall it hangs on.
  const Pose2 in_wall{poster.along_m, side * (wall.thickness_m + kPosterThickness_m) / 2, side > 0 ? 0 : kPi};
  solids_.push_back({"poster on " + wall.name,
                     LineOf(wall).map_from_line * in_wall,
                     {poster.width_m, kPosterThickness_m},
                     poster.bottom_m,
                     poster.bottom_m + poster.height_m,
                     poster.material});
}

void Builder::AddBox(const BoxPlan& box) {
  const auto within = [this](double spread) { return rng_.Uniform(-1, 1) * spread; };
  const double x = box.x_m + within(box.spread_m), y = box.y_m + within(box.spread_m);
  const double yaw = Radians(box.yaw_deg + within(box.spread_deg));
  solids_.push_back({box.name,
                     {x, y, WrapAngle(yaw)},
                     {box.length_m, box.width_m},
                     box.bottom_m,
                     box.bottom_m + box.height_m,
                     box.material});
}

void Builder::MakeNamesUnique() {
  std::set<std::string> used;
  std::map<std::string, int> of_name;
  for (auto& solid : solids_) {
    const std::string name = solid.name;
    int& number = of_name[name];
    do solid.name = ++number == 1 ? name : fmt::format("{} {}", name, number);
    while (!used.insert(solid.name).second);
  }
}

}  // namespace

std::vector<Solid> BuildSolids(const GroundPlan& map, const WorldPlan& plan, std::uint64_t seed) {
  return Builder(map, plan, seed).Build();
}

}  // namespace priamos::world
