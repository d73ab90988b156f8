#include "test/support/door_scene.hpp"

#include <string>

namespace priamos::test {

namespace {

using world::Solid;

constexpr double kCeiling_m = 2.8;
constexpr double kFront = 5.93, kStop = 6.03, kBack = 6.07;  // x of the wall's faces and of the rebate
constexpr double kRight = 1.95, kLeft = 2.85;                // y of the opening
constexpr double kFrame = 0.06, kProtrusion = 0.015, kRebate = 0.015;
constexpr double kLeafWidth = 0.92, kLeafThickness = 0.04;

class Builder {
 public:
  void Box(const std::string& name, const std::string& material, double x0, double x1, double y0, double y1,
           double z0, double z1) {
    solids_.push_back({name, {(x0 + x1) / 2, (y0 + y1) / 2, 0}, {x1 - x0, y1 - y0}, z0, z1, material});
  }
  void Add(const Solid& solid) { solids_.push_back(solid); }
  std::vector<Solid> solids() const { return solids_; }

 private:
  std::vector<Solid> solids_;
};

void AddWalls(Builder& b) {
  b.Box("west wall", "plaster", -0.14, 0, -0.14, 4.94, 0, kCeiling_m);
  b.Box("south wall", "plaster", -0.14, 10.14, -0.14, 0, 0, kCeiling_m);
  b.Box("north wall", "plaster", -0.14, 10.14, 4.8, 4.94, 0, kCeiling_m);
  b.Box("east wall", "plaster", 10, 10.14, -0.14, 4.94, 0, kCeiling_m);
  b.Box("wall right of the door", "plaster", kFront, kBack, 0, kRight - kFrame, 0, kCeiling_m);
  b.Box("wall left of the door", "plaster", kFront, kBack, kLeft + kFrame, 4.8, 0, kCeiling_m);
  b.Box("wall above the door", "plaster", kFront, kBack, kRight - kFrame, kLeft + kFrame,
        kDoorHeight_m + kFrame, kCeiling_m);
}

void AddFrame(Builder& b) {
  const double top = kDoorHeight_m + kFrame;
  b.Box("right jamb", "door_frame", kFront - kProtrusion, kStop, kRight - kFrame, kRight, 0, top);
  b.Box("right rebate", "door_frame", kStop, kBack, kRight - kFrame, kRight - kRebate, 0, top);
  b.Box("left jamb", "door_frame", kFront - kProtrusion, kStop, kLeft, kLeft + kFrame, 0, top);
  b.Box("left rebate", "door_frame", kStop, kBack, kLeft + kRebate, kLeft + kFrame, 0, top);
  b.Box("lintel", "door_frame", kFront - kProtrusion, kStop, kRight, kLeft, kDoorHeight_m, top);
  b.Box("lintel rebate", "door_frame", kStop, kBack, kRight - kRebate, kLeft + kRebate,
        kDoorHeight_m + kRebate, top);
}

void AddSkirting(Builder& b) {
  constexpr double kThick = 0.012, kHigh = 0.08;
  b.Box("skirting right", "skirting", kFront - kThick, kFront, 0, kRight - kFrame, 0, kHigh);
  b.Box("skirting left", "skirting", kFront - kThick, kFront, kLeft + kFrame, 4.8, 0, kHigh);
  b.Box("skirting south", "skirting", 0, kFront, 0, kThick, 0, kHigh);
  b.Box("skirting north", "skirting", 0, kFront, 4.8 - kThick, 4.8, 0, kHigh);
  b.Box("skirting east", "skirting", 10 - kThick, 10, 0, 4.8, 0, kHigh);
  b.Box("skirting far south", "skirting", kBack, 10, 0, kThick, 0, kHigh);
  b.Box("skirting far north", "skirting", kBack, 10, 4.8 - kThick, 4.8, 0, kHigh);
}

void AddFurniture(Builder& b) {
  b.Box("poster right", "poster", kFront - 0.004, kFront, 0.75, 1.35, 1.15, 2.0);
  b.Box("poster left", "poster", kFront - 0.004, kFront, 3.25, 4.1, 1.3, 1.9);
  b.Box("poster far", "poster", 9.996, 10, 2.1, 2.9, 1.2, 1.8);
  b.Box("notice", "poster", kFront - 0.003, kFront, 3.0, 3.2, 1.35, 1.65);
  b.Box("cupboard", "cupboard", 4.4, 5.4, 4.38, 4.78, 0, 1.8);
  b.Box("far shelf", "cupboard", 9.55, 9.97, 0.4, 1.6, 0, 1.9);
  b.Box("far table", "furniture", 8.6, 9.4, 3.3, 4.7, 0.70, 0.74);
  b.Box("far table leg", "metal", 8.65, 8.7, 3.35, 3.4, 0, 0.70);
  b.Box("far table leg 2", "metal", 9.3, 9.35, 3.35, 3.4, 0, 0.70);
  b.Box("carton", "cardboard", 5.2, 5.6, 0.1, 0.5, 0, 0.35);
  b.Box("bin", "metal", 5.5, 5.75, 3.5, 3.75, 0, 0.5);
}

}  // namespace

Pose2 MapFromLeaf(double leaf_angle_rad) {
  // Hinge on the left edge of the rebate's back; closed, the leaf fills the rebate; it swings into the far
  // room.
  const Pose2 map_from_hinge{kBack, kLeft + 0.01, leaf_angle_rad};
  return map_from_hinge * Pose2{-kLeafThickness / 2, -kLeafWidth / 2, 0};
}

std::vector<Solid> DoorScene(double leaf_angle_rad) {
  Builder b;
  AddWalls(b);
  AddFrame(b);
  AddSkirting(b);
  AddFurniture(b);
  b.Add({"door leaf",
         MapFromLeaf(leaf_angle_rad),
         {kLeafThickness, kLeafWidth},
         0.005,
         kDoorHeight_m,
         "door_leaf"});
  return b.solids();
}

}  // namespace priamos::test
