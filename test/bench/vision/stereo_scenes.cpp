#include "test/bench/vision/stereo_scenes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/config.hpp"
#include "head/core/stereo/space_edge.hpp"
#include "test/bench/vision/true_axes.hpp"
#include "world/world_loading.hpp"

namespace priamos::bench {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

std::string InSim(const std::string& name) {
  return PRIAMOS_SOURCE_DIR "/config/sim/" + name;
}

/// The front of something that is hit by a line of sight, map frame.
struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  Vector3d point = Vector3d::Zero(), normal = Vector3d::UnitZ();
};

void HitPlane(double height_m, const Vector3d& eye, const Vector3d& ray, Hit& nearest) {
  const double t = (height_m - eye.z()) / ray.z();
  if (t > 0 && t < nearest.distance) nearest = {t, eye + t * ray, Vector3d::UnitZ()};
}

void HitSolid(const world::Solid& solid, const Vector3d& eye, const Vector3d& ray, Hit& nearest) {
  Eigen::Isometry3d solid_from_map = world::Lift(solid.map_from_solid).inverse();
  const Vector3d e = solid_from_map * eye, r = solid_from_map.linear() * ray;
  const Vector3d low(-solid.size_m.x() / 2, -solid.size_m.y() / 2, solid.z_min_m),
      high(solid.size_m.x() / 2, solid.size_m.y() / 2, solid.z_max_m);
  double begin = 0, end = std::numeric_limits<double>::infinity();
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    const double a = (low[k] - e[k]) / r[k], b = (high[k] - e[k]) / r[k];
    if (std::min(a, b) > begin) {
      begin = std::min(a, b);
      axis = k;
    }
    end = std::min(end, std::max(a, b));
  }
  if (axis < 0 || begin >= end || begin >= nearest.distance) return;
  nearest = {begin, eye + begin * ray, solid_from_map.linear().transpose() * Vector3d::Unit(axis)};
}

struct Room {
  GroundPlan map;
  world::WorldPlan plan;
  Pose2 map_from_base;
};

world::BoxPlan Box(const std::string& name, double x, double y, const Vector3d& size, double yaw_deg,
                   const std::string& material) {
  world::BoxPlan box;
  box.name = name;
  box.x_m = x;
  box.y_m = y;
  box.yaw_deg = yaw_deg;
  box.length_m = size.x();
  box.width_m = size.y();
  box.height_m = size.z();
  box.material = material;
  return box;
}

Room DoorRoom(Rng& rng) {
  Room room{{}, LoadConfig<world::WorldPlan>(InSim("worlds/door.toml")), {}};
  room.map = LoadConfig<GroundPlan>(InSim(room.plan.map));
  room.map_from_base = {rng.Uniform(2, 4), rng.Uniform(1.6, 3.2), Radians(rng.Uniform(-25, 25))};
  return room;
}

/// Six equal doors on both sides, some of them open.
Room Corridor(Rng& rng) {
  Room room;
  room.plan = LoadConfig<world::WorldPlan>(InSim("worlds/door.toml"));
  room.plan.survey = {};  // the doors stand as they are put here
  room.plan.posters.clear();
  room.plan.boxes.clear();
  room.plan.doors.clear();
  const auto wall = [&](const char* name, double x1, double y1, double x2, double y2) {
    WallPlan& w = room.map.walls.emplace_back();
    w.name = name;
    w.from_m = {x1, y1};
    w.to_m = {x2, y2};
  };
  wall("left", 0, 1.2, 10, 1.2);
  wall("right", 0, -1.2, 10, -1.2);
  wall("end", 9.93, -1.2, 9.93, 1.2);
  for (int i = 0; i < 6; ++i) {
    DoorPlan& door = room.map.doors.emplace_back();
    door.id = i + 1;
    door.name = "door " + std::to_string(i + 1);
    door.x_m = 2.6 + 2.0 * (i / 2);
    door.y_m = i % 2 ? -1.2 : 1.2;
    door.yaw_deg = i % 2 ? -90 : 90;
    world::DoorWork& work = room.plan.doors.emplace_back();
    work.id = i + 1;
    work.open_deg = rng.Chance(0.6) ? 0 : rng.Uniform(5, 90);
  }
  room.map_from_base = {rng.Uniform(0.8, 2.5), rng.Uniform(-0.5, 0.5), Radians(rng.Uniform(-35, 35))};
  return room;
}

/// A rack of equal posts, shelves, and cartons of one size.
Room Boxes(Rng& rng) {
  Room room;
  room.plan = LoadConfig<world::WorldPlan>(InSim("worlds/door.toml"));
  room.map = LoadConfig<GroundPlan>(InSim(room.plan.map));
  room.plan.boxes.clear();
  room.plan.posters.clear();
  const double x = rng.Uniform(4.2, 5.2), pitch = rng.Uniform(0.08, 0.25);
  for (int i = 0; i < 8; ++i)
    room.plan.boxes.push_back(Box("post", x, 1.2 + pitch * i, {0.03, 0.03, 1.7}, 0, "wood"));
  for (int i = 0; i < 4; ++i) {
    auto shelf = Box("shelf", x + 0.15, 3.6, {0.3, 1.0, 0.03}, 0, "furniture");
    shelf.bottom_m = 0.3 + 0.4 * i;
    room.plan.boxes.push_back(shelf);
  }
  for (int i = 0; i < 6; ++i)
    room.plan.boxes.push_back(Box("carton", rng.Uniform(3.2, 5.6), rng.Uniform(0.6, 4.2), {0.3, 0.3, 0.3},
                                  rng.Uniform(0, 90), "cardboard"));
  room.map_from_base = {rng.Uniform(1, 2), rng.Uniform(1.8, 3.0), Radians(rng.Uniform(-12, 12))};
  return room;
}

Room MakeRoom(StereoScene scene, Rng& rng) {
  return scene == StereoScene::kDoorRoom   ? DoorRoom(rng)
         : scene == StereoScene::kCorridor ? Corridor(rng)
                                           : Boxes(rng);
}

/// What a view sees at an image point: the nearer of both sides of the edge there, since a thing's outline
/// belongs to the thing, not to what is behind it.
std::optional<Vector3d> PlaceOf(const StereoTriple& triple, const head::CameraModel& camera,
                                const Vector2d& at, const Vector2d& normal) {
  constexpr double kBeside_px = 2;
  const Eigen::Isometry3d map_from_base = world::Lift(triple.map_from_base);
  const Vector3d eye = map_from_base * head::OpticalCentre(camera);
  const auto ray = [&](const Vector2d& p) -> Vector3d {
    const Vector3d in_base = camera.image_from_base.leftCols<3>().inverse() * p.homogeneous();
    return map_from_base.linear() * in_base.normalized();
  };
  Hit best;
  for (const double side : {-kBeside_px, kBeside_px}) {
    const Vector3d r = ray(at + side * normal);
    Hit hit;
    HitPlane(0, eye, r, hit);
    HitPlane(triple.ceiling_m, eye, r, hit);
    for (const world::Solid& solid : triple.solids) HitSolid(solid, eye, r, hit);
    if (hit.distance < best.distance) best = hit;
  }
  const Vector3d r = ray(at);
  const double slope = best.normal.dot(r);
  if (!std::isfinite(best.distance) || std::abs(slope) < 0.02) return std::nullopt;
  return map_from_base.inverse() * Vector3d(eye + best.normal.dot(best.point - eye) / slope * r);
}

}  // namespace

const char* Describe(StereoScene scene) {
  constexpr const char* kWords[] = {"room with a door", "corridor of equal doors", "racks and boxes"};
  return kWords[static_cast<int>(scene)];
}

bool StereoTriple::IsSameEdge(const head::CameraView& first, int line, const head::CameraView& second,
                              int other) const {
  constexpr double kReach_px = 2.5;
  return std::min(Beside(first, line, second, other), Beside(second, other, first, line)) < kReach_px;
}

double StereoTriple::Beside(const head::CameraView& first, int line, const head::CameraView& second,
                            int other) const {
  const head::ViewLine &a = first.lines[line], &b = second.lines[other];
  std::vector<double> distances;
  for (const double part : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    const auto place = PlaceOf(*this, *first.camera, a.p + part * (a.q - a.p), a.normal);
    if (!place || head::MetricDepth(*second.camera, *place) < 0.1) continue;
    distances.push_back(std::abs(b.normal.dot(second.camera->Project(*place) - b.p)));
  }
  if (distances.empty()) return std::numeric_limits<double>::infinity();
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  return distances[distances.size() / 2];
}

StereoStage::StereoStage() : graphics_(world::Renderer::HoldGraphics()) {}

StereoTriple StereoStage::Take(StereoScene scene, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "stereo"), noise = Rng::Stream(seed, "noise");
  const Room room = MakeRoom(scene, rng);
  world::RendererConfig config;
  config.scene = world::DrawLight(room.plan, seed);
  config.head = world::HeadBuild::Specimen(seed);
  StereoTriple triple;
  triple.solids = world::BuildSolids(room.map, room.plan, seed);
  triple.map_from_base = room.map_from_base;
  triple.ceiling_m = config.scene.ceiling_m;
  world::Renderer renderer(config, triple.solids, seed);
  const world::HeadAxes axes;
  const world::Viewpoint still{room.map_from_base, axes};
  for (int c = 0; c < 3; ++c) {
    const GreyImage image =
        renderer.Expose(static_cast<world::Camera>(c), still, still, {0.008, 1, 0, 0}, noise);
    triple.images[c] =
        cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())).clone();
    triple.cameras[c] = ExactCamera(config.head, c, axes);
  }
  return triple;
}

}  // namespace priamos::bench
