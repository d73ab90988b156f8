// Obstacles by the line laser: how small, how far, how often wrongly.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "common/geometry.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/floor/obstacle_lines.hpp"
#include "test/bench/vision/vision_bench.hpp"
#include "test/support/image_from_base.hpp"
#include "test/support/laser_floor.hpp"
#include "world/core/render/renderer.hpp"

namespace priamos::bench {
namespace {

using namespace head;
using Eigen::Vector3d;
using support::LaserFloor;

constexpr double kTurnSigma_rad = 0.0005, kShiftSigma_m = 0.0005, kCameraSigma_px = 0.15;

/// What the head believes of camera and lasers: wrong by what calibration leaves.
struct Belief {
  CameraModel camera;
  std::vector<LaserPlane> lasers;
};

LaserPlane CalibratedWrongly(const LaserPlane& truth, Rng& rng) {
  const Vector3d turn(rng.Normal(kTurnSigma_rad), rng.Normal(kTurnSigma_rad), rng.Normal(kTurnSigma_rad));
  LaserPlane laser = truth;
  laser.normal = (laser.normal + turn.cross(laser.normal)).normalized();
  laser.offset_m = -laser.normal.dot(laser.pivot_m) + truth.Plane().signedDistance(laser.pivot_m) +
                   rng.Normal(kShiftSigma_m);
  laser.sigma_turn_rad = kTurnSigma_rad;
  laser.sigma_shift_m = kShiftSigma_m;
  return laser;
}

Belief CalibratedWrongly(const LaserFloor& scene, Rng& rng) {
  Belief belief{scene.camera, {}};
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = rng.Normal(kCameraSigma_px);
  shift(1, 2) = rng.Normal(kCameraSigma_px);
  belief.camera.image_from_base = shift * scene.camera.image_from_base;
  for (const LaserPlane& laser : scene.lasers) belief.lasers.push_back(CalibratedWrongly(laser, rng));
  return belief;
}

/// Lines on the floor so far before the robot, with the camera tilted to have their middle in that of its
/// picture, or tilted otherwise.
struct Lines {
  std::vector<double> distances_m;
  std::optional<double> tilt_rad{};
};

LaserFloor FloorWith(const Lines& lines) {
  LaserFloor scene = support::NominalLaserFloor();
  scene.lasers.clear();
  double down = 0;
  for (const double distance : lines.distances_m) {
    scene.lasers.push_back(support::FanTo(distance, scene.source));
    down += std::atan2(1.32, distance - 0.27) / static_cast<double>(lines.distances_m.size());
  }
  scene.camera = support::ThirdCamera(lines.tilt_rad.value_or(std::min(Radians(45), down)));
  return scene;
}

/// The lasers as shipped, as a head that nobody needs sees them, and as a glance ahead does.
const Lines kBoth{{2.1, 3.0}, Radians(31)}, kGlance{{2.1, 3.0}, Radians(12)};

/// Another robot, floor, light and covering every time.
void Vary(LaserFloor& scene, const std::vector<cv::Mat>& textures, Rng& rng) {
  const FloorTolerance tolerance;
  scene.heave_m = rng.Normal(tolerance.heave_m);
  scene.pitch_rad = rng.Normal(tolerance.pitch_rad);
  scene.roll_rad = rng.Normal(tolerance.roll_rad);
  scene.amplitude = rng.Uniform(60, 150);
  scene.speckle = rng.Uniform(0.05, 0.35);
  scene.background = rng.Uniform(25, 90);
  scene.noise = rng.Uniform(1, 3);
  scene.texture = &textures[rng.Below(textures.size())];
}

struct Tally {
  int frames = 0, alarms = 0, blind = 0;
  double seconds = 0;
};

Tally PlainFloors(int frames, const Lines& where, const std::vector<cv::Mat>& textures, Rng rng,
                  bool verbose) {
  Tally tally;
  ObstacleFinder dut;
  for (; tally.frames < frames; ++tally.frames) {
    LaserFloor scene = FloorWith(where);
    Vary(scene, textures, rng);
    const Belief belief = CalibratedWrongly(scene, rng);
    const GreyImage picture = Render(scene, rng);
    const double start = CpuSeconds();
    const ObstacleLines lines = dut.Find(picture, belief.camera, belief.lasers);
    tally.seconds += CpuSeconds() - start;
    tally.alarms += lines.verdict == ObstacleLines::kObstacle;
    tally.blind += lines.verdict == ObstacleLines::kBlind;
    if (!verbose || lines.verdict != ObstacleLines::kObstacle) continue;
    for (const ObstaclePiece& p : lines.pieces)
      fmt::print(
          "    frame {}: kind {}, {:.4f} +- {:.4f} m, from y {:.3f} to {:.3f}, x {:.2f}; amplitude {:.0f}\n",
          tally.frames, int(p.kind), p.height_m, p.sigma_height_m, p.right.y(), p.left.y(), p.left.x(),
          scene.amplitude);
  }
  return tally;
}

struct Sizes {
  double distance_m, height_m;
  bool whole = false;  ///< across all of the line
  Lines lines{};       ///< without any: one at distance_m
};

/// Share of frames in which something of the right sign is told where it is.
double Found(const Sizes& what, int frames, const std::vector<cv::Mat>& textures, Rng rng,
             double& height_rms) {
  int found = 0;
  double squares = 0;
  ObstacleFinder dut;
  for (int i = 0; i < frames; ++i) {
    LaserFloor scene = FloorWith(what.lines.distances_m.empty() ? Lines{{what.distance_m}} : what.lines);
    Vary(scene, textures, rng);
    const double y = rng.Uniform(-0.35, 0.25) * what.distance_m / 2, width = what.whole ? 8 : 0.2;
    const double from = what.whole ? -4 : y;
    const double reach = what.height_m < 0 && what.lines.distances_m.empty() ? 1.5 : 0.3;
    scene.steps = {{what.distance_m - 0.25, what.distance_m + reach, from, from + width, what.height_m,
                    rng.Uniform(0.5, 1.2)}};
    const Belief belief = CalibratedWrongly(scene, rng);
    const ObstacleLines lines = dut.Find(Render(scene, rng), belief.camera, belief.lasers);
    for (const ObstaclePiece& p : lines.pieces) {
      const double middle = (p.right.y() + p.left.y()) / 2;
      const bool there = std::abs(p.right.x() - what.distance_m) < 0.4;
      if (p.height_m * what.height_m <= 0 || middle < from || middle > from + width || !there) continue;
      ++found;
      squares += std::pow(p.height_m - what.height_m, 2);
      break;
    }
  }
  height_rms = found > 0 ? std::sqrt(squares / found) : 0;
  return static_cast<double>(found) / frames;
}

/// The true row of the line on a level floor [distorted px].
double TrueRow(const LaserFloor& scene, double u) {
  double low = 0, high = scene.height - 1;
  const Eigen::Matrix3d inverse = scene.camera.image_from_base.leftCols<3>().inverse();
  const Vector3d eye = -inverse * scene.camera.image_from_base.col(3);
  const auto beyond = [&](double v) {
    const Vector3d ray = inverse * scene.camera.Undistort({u, v}).homogeneous();
    const double travel = -eye.z() / ray.z();
    return travel < 0 || scene.lasers[0].Plane().signedDistance(eye + travel * ray) > 0;
  };
  for (int i = 0; i < 40; ++i) (beyond((low + high) / 2) ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

double RowError(int frames, const std::vector<cv::Mat>& textures, Rng rng) {
  StripeFinder finder;
  double squares = 0;
  int n = 0;
  for (int i = 0; i < frames; ++i) {
    LaserFloor scene = FloorWith({{2.1}});
    Vary(scene, textures, rng);
    scene.heave_m = scene.pitch_rad = scene.roll_rad = 0;
    for (const StripePoint& p : finder.Find(Render(scene, rng))) {
      const double error = p.at.y() - TrueRow(scene, p.at.x());
      if (std::abs(error) < 3) {
        squares += error * error;
        ++n;
      }
    }
  }
  return std::sqrt(squares / n);
}

/// The world's own renderer, which knows nothing of the scenes above.
struct Rendered {
  int frames = 0, alarms = 0, blind = 0;
};

Rendered RenderedFloors(int frames, const std::vector<world::Solid>& solids, double speed_m_s, Rng rng) {
  Rendered tally;
  ObstacleFinder dut;
  const char* kFloors[] = {"lino", "tiles", "carpet", "wood"};
  for (int scene = 0; tally.frames < frames; ++scene) {
    world::RendererConfig config;
    config.scene.x_min_m = -2;
    config.scene.x_max_m = 9;
    config.scene.y_min_m = -4;
    config.scene.y_max_m = 4;
    config.scene.floor = kFloors[scene % 4];
    config.head = world::HeadBuild::Specimen(5);
    world::Renderer renderer(config, solids, rng.Below(1000));
    for (int i = 0; i < 10 && tally.frames < frames; ++i, ++tally.frames) {
      world::Viewpoint at;
      at.head.tilt_rad = kBoth.tilt_rad.value();
      if (solids.empty()) at.map_from_base = {rng.Uniform(-1, 3), rng.Uniform(-2, 2), rng.Uniform(-0.4, 0.4)};
      world::Viewpoint after = at;
      after.map_from_base.x += 0.008 * speed_m_s;
      const world::TrueCamera lens = world::CameraAt(config.head, world::kThirdCamera, at.head);
      const CameraModel camera{world::ImageFromBase(lens), lens.centre_px, lens.focal_px, lens.k1, lens.k2};
      std::vector<LaserPlane> lasers;
      for (const world::LaserBuild& build : config.lasers) {
        const auto plane = build.Plane();
        lasers.push_back({plane.normal(), plane.offset(), {-plane.offset() / plane.normal().x(), 0, 0.05}});
      }
      const GreyImage picture = renderer.Expose(world::kThirdCamera, at, after, {0.008, 1, 0, 0.7}, rng);
      const ObstacleLines lines = dut.Find(picture, camera, lasers);
      tally.alarms += lines.verdict == ObstacleLines::kObstacle;
      tally.blind += lines.verdict == ObstacleLines::kBlind;
    }
  }
  return tally;
}

void BenchPlainFloors(const VisionOptions& options, const std::vector<cv::Mat>& textures, Figures& figures) {
  const int scale = options.quick ? 10 : 1;
  Tally plain;
  const std::pair<const char*, Lines> kinds[] = {
      {"near", {{1.2}}}, {"one", {{2.1}}}, {"pair", kBoth}, {"glance", kGlance}};
  for (const auto& [name, lines] : kinds) {
    const Tally t = PlainFloors(2500 / scale, lines, textures,
                                Rng::Stream(options.seed, fmt::format("plain {}", name)), options.verbose);
    plain.frames += t.frames;
    plain.alarms += t.alarms;
    plain.blind += t.blind;
    if (name == std::string_view("one"))
      figures.AtMost("  time of a frame with one line, CPU", 1000 * t.seconds / t.frames, 0.3, "ms");
    if (name == std::string_view("pair"))
      figures.AtMost("  time of a frame with two, CPU", 1000 * t.seconds / t.frames, 0.6, "ms");
  }
  figures.AtMost(fmt::format("  false alarms in {} frames of plain floor", plain.frames), plain.alarms, 0,
                 "");
  figures.Note("  frames that tell nothing", 100.0 * plain.blind / plain.frames, "%");
}

std::string NameOf(const Sizes& what) {
  const bool pair = what.lines.tilt_rad == kBoth.tilt_rad, glance = what.lines.tilt_rad == kGlance.tilt_rad;
  return fmt::format("  {}{:.0f} cm {} at {:.1f} m, {}: found",
                     pair     ? "two lines: "
                     : glance ? "in a glance: "
                              : "",
                     100 * std::abs(what.height_m), what.height_m > 0 ? "up" : "down", what.distance_m,
                     what.whole ? "across all of the line" : "20 cm wide");
}

void BenchSteps(const VisionOptions& options, const std::vector<cv::Mat>& textures, Figures& figures) {
  const Sizes steps[] = {{2.0, 0.03},
                         {2.0, -0.03},
                         {2.0, 0.02},
                         {2.0, -0.02},
                         {2.0, 0.05},
                         {2.0, -0.05},
                         {1.2, 0.03},
                         {1.2, -0.03},
                         {2.0, 0.03, true},
                         {2.0, -0.03, true},
                         {2.0, -0.05, true},
                         {2.0, 0.03, true, kBoth},
                         {2.0, -0.03, true, kBoth},
                         {3.0, 0.03, true, kBoth},
                         {3.0, -0.03, true, kBoth},
                         {3.0, 0.03, true, kGlance},
                         {3.0, -0.03, true, kGlance},
                         {3.0, 0.05, true, kGlance},
                         {3.0, -0.05, true, kGlance},
                         {3.0, 0.03, false, kGlance},
                         {3.0, -0.03, false, kGlance}};
  for (const Sizes& what : steps) {
    double rms = 0;
    const double found =
        Found(what, options.quick ? 30 : 300, textures,
              Rng::Stream(options.seed, fmt::format("{} {}", what.distance_m, what.height_m)), rms);
    const bool pair = what.lines.tilt_rad == kBoth.tilt_rad;
    if (std::abs(what.height_m) == 0.03 && (pair || !what.whole))
      figures.AtLeast(NameOf(what), 100 * found, pair ? 97 : 99, "%");
    else
      figures.Note(NameOf(what), 100 * found, "%");
    figures.Note("    its height, RMS", 1000 * rms, "mm");
  }
}

void BenchRendered(const VisionOptions& options, Figures& figures) {
  const int scale = options.quick ? 10 : 1;
  const Rendered floor = RenderedFloors(200 / scale, {}, 0.5, Rng::Stream(options.seed, "rendered"));
  figures.AtMost(fmt::format("  world's renderer, at 0.5 m/s: false alarms in {} frames", floor.frames),
                 floor.alarms, 0, "");
  figures.Note("  frames that tell nothing", floor.blind, "");
  const Rendered box =
      RenderedFloors(40 / scale, {{"slab", {2.1, 0.1, 0.3}, {0.4, 0.3}, 0, 0.03, "door_frame"}}, 0.5,
                     Rng::Stream(options.seed, "box"));
  figures.AtLeast(fmt::format("  a slab of 3 cm: found in {} frames", box.frames),
                  100.0 * box.alarms / box.frames, 99, "%");
}

}  // namespace

void BenchLaser(const VisionOptions& options, Figures& figures) {
  Rng rng = Rng::Stream(options.seed, "laser");
  std::vector<cv::Mat> textures;
  for (int i = 0; i < 60; ++i) textures.push_back(support::FloorTexture(rng));
  fmt::print(
      "line lasers: 60 floors with joints, blotches and reflections; the robot nods, the calibration is "
      "wrong\n");
  figures.AtMost("  RMS of a column",
                 RowError(options.quick ? 10 : 100, textures, Rng::Stream(options.seed, "row")), 0.12, "px");
  BenchPlainFloors(options, textures, figures);
  BenchSteps(options, textures, figures);
  BenchRendered(options, figures);
}

}  // namespace priamos::bench
