#include "world/core/render/renderer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "common/config.hpp"
#include "test/support/door_scene.hpp"

namespace priamos::world {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// Even light, no noise, nothing around: only the geometry is left.
RendererConfig Plain() {
  RendererConfig config;
  config.scene.ambient = 1;
  config.scene.window = 0;
  config.scene.brightness = 1.5;
  config.scene.x_min_m = 19;
  config.scene.x_max_m = 20;
  config.scene.y_min_m = 19;
  config.scene.y_max_m = 20;
  config.imaging.read_noise = config.imaging.photon_noise = config.imaging.vignetting =
      config.imaging.defocus_px = 0;
  return config;
}

/// A board across the view, its front at x = 2.5 m.
std::vector<Solid> Board() {
  return {{"board", {2.505, 0, 0}, {0.01, 0.6}, 0.95, 1.4, "door_frame"}};
}

const std::array<std::pair<Vector3d, Vector3d>, 4> kBoardEdges = {{{{2.5, 0.3, 0.95}, {2.5, 0.3, 1.4}},
                                                                   {{2.5, -0.3, 0.95}, {2.5, -0.3, 1.4}},
                                                                   {{2.5, 0.3, 0.95}, {2.5, -0.3, 0.95}},
                                                                   {{2.5, 0.3, 1.4}, {2.5, -0.3, 1.4}}}};

double Grey(const GreyImage& image, const Vector2d& p) {
  const int u = static_cast<int>(std::floor(p.x())), v = static_cast<int>(std::floor(p.y()));
  const double a = p.x() - u, b = p.y() - v;
  const auto pixel = [&](int i, int j) { return double(image.pixels.at((v + j) * image.width + u + i)); };
  return (1 - b) * ((1 - a) * pixel(0, 0) + a * pixel(1, 0)) + b * ((1 - a) * pixel(0, 1) + a * pixel(1, 1));
}

struct Step {
  double offset = 0;  ///< centroid of the derivative across the edge, from the expected place [px]
  double width = 0;   ///< its sigma [px]
};

Step MeasureStep(const GreyImage& image, const Vector2d& at, const Vector2d& normal) {
  constexpr double kReach = 6, kStep = 0.1;
  double weight = 0, first = 0, second = 0;
  for (double s = -kReach; s < kReach; s += kStep) {
    const double slope = Grey(image, at + (s + kStep) * normal) - Grey(image, at + s * normal);
    const double middle = s + kStep / 2;
    weight += slope;
    first += slope * middle;
    second += slope * middle * middle;
  }
  const double offset = first / weight;
  return {offset, std::sqrt(std::max(0.0, second / weight - offset * offset))};
}

/// Steps along the image of the straight edge from a to b (base frame), from its exact projection.
std::vector<Step> MeasureEdge(const GreyImage& image, const TrueCamera& camera, const Vector3d& a,
                              const Vector3d& b) {
  std::vector<Step> steps;
  for (double t = 0.1; t < 0.9; t += 0.01) {
    const Vector2d p = camera.Project(a + t * (b - a)), q = camera.Project(a + (t + 0.001) * (b - a));
    const Vector2d along = (q - p).normalized();
    steps.push_back(MeasureStep(image, p, Vector2d(-along.y(), along.x())));
  }
  return steps;
}

double Mean(const std::vector<Step>& steps, double Step::*what) {
  double sum = 0;
  for (const Step& s : steps) sum += s.*what;
  return sum / static_cast<double>(steps.size());
}

double SpreadOfOffsets(const std::vector<Step>& steps) {
  const double mean = Mean(steps, &Step::offset);
  double sum = 0;
  for (const Step& s : steps) sum += (s.offset - mean) * (s.offset - mean);
  return std::sqrt(sum / static_cast<double>(steps.size()));
}

double MeanGrey(const GreyImage& image, const Vector2d& centre, int half) {
  double sum = 0;
  for (int j = -half; j <= half; ++j) {
    for (int i = -half; i <= half; ++i) sum += Grey(image, centre + Vector2d(i, j));
  }
  return sum / ((2 * half + 1) * (2 * half + 1));
}

class RendererTest : public ::testing::Test {
 protected:
  // A context costs more than a picture.
  static void SetUpTestSuite() { dut_ = std::make_unique<Renderer>(Plain(), Board(), 1); }
  static void TearDownTestSuite() { dut_.reset(); }

  GreyImage Expose(const Viewpoint& at, Camera camera = kLeftCamera, const Exposure& exposure = {}) {
    Rng rng(1);
    return dut_->Expose(camera, at, at, exposure, rng);
  }
  GreyImage ExposeMoving(const Viewpoint& from, const Viewpoint& to, const Exposure& exposure = {}) {
    Rng rng(1);
    return dut_->Expose(kLeftCamera, from, to, exposure, rng);
  }

  static std::unique_ptr<Renderer> dut_;
};
std::unique_ptr<Renderer> RendererTest::dut_;

TEST_F(RendererTest, EdgesAreWhereTheExactProjectionSays) {
  for (int i = 0; i < 8; ++i) {
    RendererConfig config = Plain();
    config.head = HeadBuild::Specimen(i);
    dut_->SetScene(config, Board(), 1);
    Viewpoint at;
    at.head.pan_rad = 0.013 * i - 0.05;
    at.head.tilt_rad = 0.005 * i;
    const auto camera = static_cast<Camera>(i % kCameras);
    const GreyImage image = Expose(at, camera);
    const TrueCamera truth = CameraAt(config.head, camera, at.head);
    for (const auto& [a, b] : kBoardEdges) {
      EXPECT_NEAR(Mean(MeasureEdge(image, truth, a, b), &Step::offset), 0, 0.03) << "head " << i;
    }
  }
}

TEST_F(RendererTest, InclinedEdgesHaveNoStaircase) {
  for (const double roll : {0.004, 0.012, 0.03, 0.1}) {
    RendererConfig config = Plain();
    config.head.cameras[kLeftCamera].roll_rad = roll;
    dut_->SetScene(config, Board(), 1);
    const GreyImage image = Expose({});
    const TrueCamera truth = CameraAt(config.head, kLeftCamera, {});
    for (const auto& [a, b] : kBoardEdges) {
      const std::vector<Step> steps = MeasureEdge(image, truth, a, b);
      EXPECT_LT(SpreadOfOffsets(steps), 0.05) << "roll " << roll;
      EXPECT_NEAR(Mean(steps, &Step::width), 0.85, 0.25) << "as blurred as pixel and lens make it";
    }
  }
}

TEST_F(RendererTest, SameArgumentsGiveTheSameBytes) {
  RendererConfig config;
  dut_->SetScene(config, test::DoorScene(), 3);
  const Viewpoint at{{2.5, 2.3, 0.05}, {}};
  const GreyImage first = Expose(at);
  EXPECT_EQ(first.width, 768);
  EXPECT_EQ(first.height, 576);
  EXPECT_EQ(first.pixels.size(), 768U * 576U);
  Expose({{1.0, 2.0, 0.3}, {}}, kRightCamera);  // what came between must not matter
  EXPECT_EQ(first.pixels, Expose(at).pixels);
  dut_->SetScene(config, Board(), 1);
  dut_->SetScene(config, test::DoorScene(), 3);
  EXPECT_EQ(first.pixels, Expose(at).pixels) << "another world between";
  Rng other(2);
  EXPECT_NE(first.pixels, dut_->Expose(kLeftCamera, at, at, {}, other).pixels)
      << "the noise is the generator's";
  dut_->SetScene(config, test::DoorScene(), 4);
  EXPECT_NE(first.pixels, Expose(at).pixels) << "the seed decides textures";
}

TEST_F(RendererTest, ASecondContextAfterTheFirstDrawsTheSame) {
  dut_->SetScene(Plain(), Board(), 1);
  const GreyImage first = Expose({});
  dut_.reset();
  dut_ = std::make_unique<Renderer>(Plain(), Board(), 1);
  EXPECT_EQ(first.pixels, Expose({}).pixels);
}

TEST_F(RendererTest, TwoWorldsLiveSideBySide) {
  dut_->SetScene(Plain(), Board(), 1);
  const GreyImage before = Expose({});
  Rng rng(1);
  {
    Renderer other(RendererConfig{}, test::DoorScene(), 2);
    EXPECT_NE(other.Expose(kLeftCamera, {}, {}, {}, rng).pixels, before.pixels);
    EXPECT_EQ(Expose({}).pixels, before.pixels);
  }
  EXPECT_EQ(Expose({}).pixels, before.pixels);
}

TEST_F(RendererTest, MotionSmearsAroundTheMiddlePose) {
  dut_->SetScene(Plain(), Board(), 1);
  const Viewpoint still;
  Viewpoint opening, closing;
  opening.map_from_base.yaw = -0.002;
  closing.map_from_base.yaw = 0.002;  // 4 px at 1000 px focal length
  const TrueCamera truth = CameraAt(Plain().head, kLeftCamera, {});
  const auto& [a, b] = kBoardEdges[0];
  const std::vector<Step> sharp = MeasureEdge(Expose(still), truth, a, b);
  const std::vector<Step> smeared = MeasureEdge(ExposeMoving(opening, closing), truth, a, b);
  EXPECT_NEAR(Mean(smeared, &Step::offset), Mean(sharp, &Step::offset), 0.1);
  // A smear of s px has a sigma of s / sqrt(12).
  const Eigen::Isometry3d turn = Lift(closing.map_from_base);
  const double shift = 2 * (truth.Project(turn.inverse() * a) - truth.Project(a)).x();
  const double expected = std::hypot(Mean(sharp, &Step::width), shift / std::sqrt(12.0));
  EXPECT_NEAR(Mean(smeared, &Step::width), expected, 0.1);
}

TEST_F(RendererTest, HeadMotionSmearsLikeRobotMotion) {
  dut_->SetScene(Plain(), Board(), 1);
  Viewpoint opening, closing;
  opening.head.pan_rad = -0.002;
  closing.head.pan_rad = 0.002;
  const TrueCamera truth = CameraAt(Plain().head, kLeftCamera, {});
  const auto& [a, b] = kBoardEdges[0];
  EXPECT_GT(Mean(MeasureEdge(ExposeMoving(opening, closing), truth, a, b), &Step::width), 1.2);
}

TEST_F(RendererTest, WrongFocusBlurs) {
  RendererConfig config = Plain();
  config.imaging.defocus_px = 4;
  dut_->SetScene(config, Board(), 1);
  Viewpoint near;
  near.head.focus_step = {400, 400};
  const auto& [a, b] = kBoardEdges[0];
  const TrueCamera truth = CameraAt(Plain().head, kLeftCamera, near.head);
  EXPECT_GT(Mean(MeasureEdge(Expose(near), truth, a, b), &Step::width), 2.5);
}

TEST_F(RendererTest, LongerExposureAndGainBrighten) {
  dut_->SetScene(Plain(), Board(), 1);
  const Vector2d board(384, 300);
  const double normal = MeanGrey(Expose({}), board, 20) - Plain().imaging.black_level;
  ASSERT_GT(normal, 20);
  EXPECT_NEAR(MeanGrey(Expose({}, kLeftCamera, {0.005, 1, 0}), board, 20) - 8, normal / 2, 1.5);
  EXPECT_NEAR(MeanGrey(Expose({}, kLeftCamera, {0.010, 1.5, 0}), board, 20) - 8, normal * 1.5, 1.5);
}

TEST_F(RendererTest, TheDoorLeafMoves) {
  dut_->SetScene(RendererConfig{}, test::DoorScene(1.75), 1);
  const Viewpoint at{test::kMapFromDoor * Pose2{-3, 0, 0}, {}};
  const Vector2d opening = CameraAt(HeadBuild{}, kLeftCamera, {}).Project({3.05, 0.0, 1.3});
  const double open = MeanGrey(Expose(at), opening, 10);
  dut_->MoveSolid("door leaf", test::MapFromLeaf(0));
  EXPECT_GT(std::abs(MeanGrey(Expose(at), opening, 10) - open), 8);
  dut_->MoveSolid("door leaf", test::MapFromLeaf(1.75));
  EXPECT_NEAR(MeanGrey(Expose(at), opening, 10), open, 0.5);
  EXPECT_THROW(dut_->MoveSolid("cat flap", {}), std::invalid_argument);
}

TEST_F(RendererTest, FrontAndRevealOfTheFrameDiffer) {
  dut_->SetScene(RendererConfig{}, test::DoorScene(), 1);
  const Viewpoint at{test::kMapFromDoor * Pose2{-2.4, 0, 0}, {}};
  const GreyImage image = Expose(at);
  const TrueCamera camera = CameraAt(HeadBuild{}, kLeftCamera, {});
  // In the base frame the opening is 2.4 m ahead; the left camera sees the right reveal.
  const double front = MeanGrey(image, camera.Project({2.4 - 0.085, -0.48, 1.2}), 4);
  const double reveal = MeanGrey(image, camera.Project({2.4 - 0.03, -0.45, 1.2}), 2);
  const double wall = MeanGrey(image, camera.Project({2.4 - 0.07, -0.58, 1.2}), 4);
  EXPECT_GT(std::abs(front - reveal), 6);
  EXPECT_GT(std::abs(front - wall), 15);
}

TEST_F(RendererTest, AnUnknownMaterialIsRefusedAndTheOldWorldStays) {
  dut_->SetScene(Plain(), Board(), 1);
  const GreyImage before = Expose({});
  EXPECT_THROW(dut_->SetScene(Plain(), {{"wall", {}, {1, 1}, 0, 1, "cheese"}}, 1), std::invalid_argument);
  EXPECT_EQ(before.pixels, Expose({}).pixels);
}

TEST_F(RendererTest, EveryLaserLineIsWhereItsPlaneMeetsTheFloor) {
  RendererConfig config = Plain();
  config.scene.x_min_m = -1;
  config.scene.x_max_m = 8;
  config.scene.y_min_m = -3;
  config.scene.y_max_m = 3;
  dut_->SetScene(config, {}, 1);
  Viewpoint at;
  at.head.tilt_rad = 0.5;
  const GreyImage image = Expose(at, kThirdCamera, {0.004, 1, 0, 3});
  const GreyImage off = Expose(at, kThirdCamera, {0.004, 1, 0, 0});
  const TrueCamera camera = CameraAt(config.head, kThirdCamera, at.head);
  ASSERT_EQ(config.lasers.size(), 2U);
  for (const LaserBuild& laser : config.lasers) {
    const double x = laser.x_m + laser.z_m / std::tan(laser.pitch_rad);
    for (double y = -0.4; y < 0.41; y += 0.02) {
      const Vector2d place = camera.Project({x, y, 0});
      double weight = 0, moment = 0;
      for (int v = -8; v <= 8; ++v) {
        const double row = std::round(place.y()) + v;
        const double light = std::max(0.0, Grey(image, {place.x(), row}) - 60);
        weight += light;
        moment += light * row;
      }
      ASSERT_GT(weight, 100);
      EXPECT_NEAR(moment / weight, place.y(), 0.1);
    }
    EXPECT_LT(MeanGrey(off, camera.Project({x, 0, 0}), 1), 60) << "only when it is on";
  }
}

// --- the calibration body ---

ReferenceObject StandardObject() {
  return LoadConfig<ReferenceObject>(PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml");
}

/// Centre of gravity of the area that the disc covers in the image, by summing small cells.
Vector2d ExactCentroid(const ReferenceDisc& disc, const std::function<Vector2d(const Vector3d&)>& project) {
  constexpr int kRings = 24, kSectors = 96;
  const Vector3d a = Vector3d::UnitZ().cross(disc.normal).normalized(), b = disc.normal.cross(a);
  const auto corner = [&](int i, int j) {
    const double r = disc.radius_m * i / kRings, angle = 2 * kPi * j / kSectors;
    return project(disc.centre_m + r * (std::cos(angle) * a + std::sin(angle) * b));
  };
  double area = 0;
  Vector2d moment = Vector2d::Zero();
  const auto triangle = [&](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    const double size = (q - p).x() * (r - p).y() - (q - p).y() * (r - p).x();
    area += size;
    moment += size * (p + q + r) / 3;
  };
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSectors; ++j) {
      triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
      triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  }
  return moment / area;
}

Vector2d GreyCentroid(const GreyImage& image, const Vector2d& near, double radius, double background) {
  double weight = 0;
  Vector2d moment = Vector2d::Zero();
  const int u0 = static_cast<int>(std::lround(near.x())), v0 = static_cast<int>(std::lround(near.y()));
  const int half = static_cast<int>(std::ceil(radius));
  for (int v = v0 - half; v <= v0 + half; ++v) {
    for (int u = u0 - half; u <= u0 + half; ++u) {
      if ((Vector2d(u, v) - near).norm() > radius) continue;
      const double w = image.pixels.at(v * image.width + u) - background;
      weight += w;
      moment += w * Vector2d(u, v);
    }
  }
  return moment / weight;
}

constexpr Exposure kCalibration{0.001, 1, 9};

TEST_F(RendererTest, DiscCentroidsAreTrue) {
  RendererConfig config = Plain();
  config.head = HeadBuild::Specimen(5);
  dut_->SetScene(config, {}, 1);
  double sum = 0;
  int count = 0;
  for (const double yaw : {-0.05, 0.0, 0.2}) {
    PlacedReference placed{StandardObject(), Eigen::Isometry3d::Identity()};
    placed.map_from_object =
        Eigen::Translation3d(1.75, 0.02, 1.2) * Eigen::AngleAxisd(kPi + yaw, Vector3d::UnitZ());
    dut_->PlaceReference(placed);
    const GreyImage image = Expose({}, kRightCamera, kCalibration);
    const TrueCamera camera = CameraAt(config.head, kRightCamera, {});
    for (const ReferenceDisc& disc : placed.object.discs) {
      const Vector2d truth =
          ExactCentroid(disc, [&](const Vector3d& p) { return camera.Project(placed.map_from_object * p); });
      const Vector2d seen = GreyCentroid(image, truth, 17, config.imaging.black_level);
      EXPECT_LT((seen - truth).norm(), 0.04);
      sum += (seen - truth).squaredNorm();
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.02);
}

TEST_F(RendererTest, DiscsShineOnlyInTheCameraLight) {
  dut_->SetScene(RendererConfig{}, test::DoorScene(), 1);
  PlacedReference placed{StandardObject(), Eigen::Isometry3d::Identity()};
  const Viewpoint at{{2, 2.4, 0}, {}};
  placed.map_from_object = Eigen::Translation3d(3.75, 2.4, 1.2) * Eigen::AngleAxisd(kPi, Vector3d::UnitZ());
  dut_->PlaceReference(placed);
  const ReferenceDisc& disc = placed.object.discs[0];
  const Eigen::Isometry3d base_from_object = Lift(at.map_from_base).inverse() * placed.map_from_object;
  const TrueCamera camera = CameraAt(HeadBuild{}, kLeftCamera, {});
  const Vector2d place = camera.Project(base_from_object * disc.centre_m);
  const Vector2d body = camera.Project(base_from_object * Vector3d(0.03, -0.14, 0.18));
  const GreyImage lit = Expose(at, kLeftCamera, kCalibration), room = Expose(at);
  EXPECT_GT(MeanGrey(lit, place, 4), 180);
  EXPECT_LT(MeanGrey(lit, body, 4), 15);
  EXPECT_LT(MeanGrey(lit, {60, 300}, 10), 40) << "the room stays dim";
  EXPECT_LT(MeanGrey(room, place, 4), 150);
  EXPECT_LT(MeanGrey(room, body, 4), 30);
  dut_->PlaceReference(std::nullopt);
  EXPECT_GT(MeanGrey(Expose(at), body, 4), 40) << "taken away";
}

/// Mean grey of a spot straight ahead of a camera in a bright room, with a black box behind a pane.
class PaneTest : public RendererTest {
 protected:
  double GreyThrough(const std::string& material) {
    std::vector<Solid> solids{{"box", {3, 0, 0}, {0.5, 1.5}, 0, 2, "carpet"}};
    if (!material.empty()) solids.push_back({"pane", {1.5, 0, 0}, {0.02, 3}, 0, 2.5, material});
    dut_->SetScene(Plain(), solids, 1);
    return MeanGrey(Expose({}), {384, 288}, 20);
  }
};

TEST_F(PaneTest, GlassIsSeenThroughAndAMirrorIsNot) {
  const double bare = GreyThrough("");
  EXPECT_NEAR(GreyThrough("glass"), bare, 3);
  EXPECT_GT(std::abs(GreyThrough("mirror") - bare), 3);
}

TEST_F(RendererTest, APersonIsSeenWhereTheyAre) {
  RendererConfig config = Plain();
  const std::vector<Solid> solids{{"person", {2.5, 0, 0}, {0.25, 0.5}, 0, 1.7, "carpet"}};
  dut_->SetScene(config, solids, 1);
  const double with = MeanGrey(Expose({}), {384, 288}, 20);
  Viewpoint at;
  at.moved = {{0, {2.5, 3, 0}}};
  const double without = MeanGrey(Expose(at), {384, 288}, 20);
  EXPECT_GT(std::abs(with - without), 5);
}

TEST_F(RendererTest, TheBottomOfAHoleIsSeenLowerThanTheFloor) {
  RendererConfig config = Plain();
  config.scene.x_min_m = config.scene.y_min_m = -5;
  config.scene.x_max_m = config.scene.y_max_m = 8;
  HolePlan hole;
  hole.x_m = 2;
  hole.length_m = 1.2;
  hole.width_m = 1.2;
  hole.depth_m = 1;
  HeadAxes down;
  down.tilt_rad = 0.5;
  const Viewpoint at{{}, down};
  dut_->SetScene(config, {}, 1);
  const GreyImage flat = Expose(at);
  config.scene.holes = {hole};
  dut_->SetScene(config, {}, 1);
  const GreyImage pit = Expose(at);
  const Vector2d edge = CameraAt(config.head, kLeftCamera, down).Project(Vector3d(2.3, 0, 0));
  EXPECT_LT(MeanGrey(pit, edge, 10), MeanGrey(flat, edge, 10) - 3) << "darker down there";
}

}  // namespace
}  // namespace priamos::world
