// Renders pictures with their truth, for work on seeing without a running robot:
//   render_samples --out DIR [--views 20] [--stands 6] [--seed 1]
// DIR gets NAME-left.png, NAME-right.png (and -third.png with --third) and truth.json: per picture the
// pinhole matrix image_from_base, the distortion, and where the robot and the calibration body truly are.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/config.hpp"
#include "test/support/door_scene.hpp"
#include "test/support/image_from_base.hpp"
#include "world/core/render/renderer.hpp"

namespace {

using namespace priamos;
using namespace priamos::world;
using nlohmann::json;

struct Options {
  std::string out = "samples", reference = PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml";
  int views = 20, stands = 6;
  std::uint64_t seed = 1;
  bool third = false, nominal = false;
};

json ToJson(const Eigen::MatrixXd& m) {
  json rows = json::array();
  for (int i = 0; i < m.rows(); ++i) {
    rows.push_back(json::array());
    for (int j = 0; j < m.cols(); ++j) rows.back().push_back(m(i, j));
  }
  return rows;
}

json ToJson(const Pose2& p) {
  return {{"x_m", p.x}, {"y_m", p.y}, {"yaw_rad", p.yaw}};
}

json CameraTruth(const TrueCamera& c) {
  return {{"image_from_base", ToJson(ImageFromBase(c))},
          {"base_from_camera", ToJson(c.base_from_camera.matrix())},
          {"focal_px", c.focal_px},
          {"centre_px", {c.centre_px.x(), c.centre_px.y()}},
          {"k1", c.k1},
          {"k2", c.k2}};
}

class Sampler {
 public:
  explicit Sampler(const Options& options)
      : options_(options),
        rng_(Rng::Stream(options.seed, "samples")),
        noise_(Rng::Stream(options.seed, "noise")),
        renderer_(Config(options), test::DoorScene(), options.seed) {
    std::filesystem::create_directories(options.out);
  }

  /// Robot before the door, somewhere, head turned by +-5 degrees.
  void DoorView(int index) {
    const double distance = rng_.Uniform(2.4, 4.0);
    const Pose2 believed{-distance - 0.25, 0, 0};
    const Pose2 door_from_base{believed.x + rng_.Uniform(-0.2, 0.2), rng_.Uniform(-0.2, 0.2),
                               Radians(rng_.Uniform(-5, 5))};
    Viewpoint at{test::kMapFromDoor * door_from_base, {}};
    for (const double pan_deg : {5.0, -5.0}) {
      at.head.pan_rad = Radians(pan_deg);
      at.head.vergence_rad = {-0.02, 0.02};
      const std::string name = "door-" + Number(index) + (pan_deg > 0 ? "-pan+5" : "-pan-5");
      json truth = Take(name, at, {});
      truth["door_from_base"] = ToJson(door_from_base);
      truth["door_from_base_believed"] = ToJson(believed);
      truth_["door"].push_back(truth);
    }
  }

  /// The calibration body before the robot, at the head setups of the door views.
  void StandView(int index, const ReferenceObject& object) {
    Viewpoint at{test::kMapFromDoor * Pose2{-4, 0, 0}, {}};
    at.head.pan_rad = Radians(index % 2 ? -5 : 5);
    at.head.vergence_rad = {-0.02, 0.02};
    const double yaw = at.head.pan_rad + Radians(rng_.Uniform(-2, 2)), distance = rng_.Uniform(1.4, 1.8);
    const Eigen::Isometry3d base_from_object =
        Eigen::Translation3d(0.25 + distance * std::cos(yaw), distance * std::sin(yaw), 1.2) *
        Eigen::AngleAxisd(yaw + kPi + Radians(rng_.Uniform(-25, 25)), Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(Radians(rng_.Uniform(-8, 8)), Eigen::Vector3d::UnitY());
    renderer_.PlaceReference(PlacedReference{object, Lift(at.map_from_base) * base_from_object});
    json truth = Take("stand-" + Number(index), at, {0.001, 1, 9});
    truth["base_from_object"] = ToJson(base_from_object.matrix());
    truth_["stand"].push_back(truth);
    renderer_.PlaceReference(std::nullopt);
  }

  void Save() {
    std::ofstream(options_.out + "/truth.json") << truth_.dump(1) << "\n";
    std::cout << "rendered " << pictures_ << " pictures, " << seconds_ / pictures_ * 1000 << " ms each\n";
  }

 private:
  static RendererConfig Config(const Options& options) {
    RendererConfig config;
    config.scene.x_min_m = -0.14;
    config.scene.x_max_m = 10.14;
    config.scene.y_min_m = -0.14;
    config.scene.y_max_m = 4.94;
    if (!options.nominal) config.head = HeadBuild::Specimen(options.seed);
    return config;
  }

  static std::string Number(int index) { return (index < 10 ? "0" : "") + std::to_string(index); }

  json Take(const std::string& name, const Viewpoint& at, const Exposure& exposure) {
    json truth{{"name", name},
               {"pan_rad", at.head.pan_rad},
               {"tilt_rad", at.head.tilt_rad},
               {"vergence_rad", at.head.vergence_rad},
               {"map_from_base", ToJson(at.map_from_base)}};
    const char* names[] = {"left", "right", "third"};
    for (int i = 0; i < (options_.third ? 3 : 2); ++i) {
      const auto camera = static_cast<Camera>(i);
      const auto start = std::chrono::steady_clock::now();
      GreyImage image = renderer_.Expose(camera, at, at, exposure, noise_);
      seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      ++pictures_;
      cv::imwrite(options_.out + "/" + name + "-" + names[i] + ".png",
                  cv::Mat(image.height, image.width, CV_8U, image.pixels.data()));
      truth[names[i]] = CameraTruth(CameraAt(renderer_.config().head, camera, at.head));
    }
    return truth;
  }

  Options options_;
  Rng rng_, noise_;
  Renderer renderer_;
  json truth_;
  int pictures_ = 0;
  double seconds_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Renders pictures with their truth");
  app.add_option("--out", options.out, "folder for pictures and truth.json");
  app.add_option("--reference", options.reference, "reference object (TOML)");
  app.add_option("--views", options.views, "robot poses before the door, two head setups each");
  app.add_option("--stands", options.stands, "views of the calibration body");
  app.add_option("--seed", options.seed);
  app.add_flag("--third", options.third, "the third camera too");
  app.add_flag("--nominal", options.nominal, "a head without manufacturing errors");
  CLI11_PARSE(app, argc, argv);
  try {
    const auto object = LoadConfig<ReferenceObject>(options.reference);
    Sampler sampler(options);
    for (int i = 0; i < options.views; ++i) sampler.DoorView(i);
    for (int i = 0; i < options.stands; ++i) sampler.StandView(i, object);
    sampler.Save();
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 2;
  }
}
