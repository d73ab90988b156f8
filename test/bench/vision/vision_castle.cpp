#include <fmt/format.h>

#include <Eigen/Dense>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "common/random.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/free_model_fix.hpp"
#include "head/files/landmark_file.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr const char* kFolder = "/usr/share/visp-images-data/ViSP-images/mbt-depth/Castle-simu/";

std::optional<Eigen::Isometry3d> Truth(int frame) {
  std::ifstream in(fmt::format("{}CameraPose/Camera_{:03}.txt", kFolder, frame));
  Eigen::Isometry3d t;
  for (int i = 0; i < 16; ++i) in >> t.matrix()(i / 4, i % 4);
  if (!in) return std::nullopt;
  return t;
}

/// Config/chateau.xml; the camera's own frame (x right, y down, z forward) is base.
head::CameraModel Camera() {
  head::CameraModel camera;
  camera.image_from_base << 700, 0, 320, 0, 0, 700, 240, 0, 0, 0, 1, 0;
  camera.centre_px = {320, 240};
  camera.scale_px = 700;
  return camera;
}

/// Evenly within a ball of `reach_m`, turned by up to `turn_deg` about any axis.
Eigen::Isometry3d Disturbed(const Eigen::Isometry3d& truth, double reach_m, double turn_deg, Rng& rng) {
  const auto direction = [&]() -> Eigen::Vector3d {
    return Eigen::Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1)).normalized();
  };
  Eigen::Isometry3d t = truth;
  t.pretranslate(Eigen::Vector3d(rng.Uniform(0, reach_m) * direction()));
  t.rotate(Eigen::AngleAxisd(Radians(rng.Uniform(0, turn_deg)), direction()));
  return t;
}

}  // namespace

void BenchCastle(const VisionOptions& options, Figures& figures) {
  if (!std::filesystem::exists(kFolder)) {
    fmt::print("ViSP's castle is not here: visp-images-data\n");
    return;
  }
  constexpr double kReach_m = 0.01, kTurn_deg = 3;
  fmt::print("ViSP's castle, each frame alone, begun up to {:.0f} mm and {:.0f} degrees beside the truth\n",
             1000 * kReach_m, kTurn_deg);
  const head::Polyhedron body = head::LoadPolyhedron(std::string(kFolder) + "Models/chateau.cao");
  const head::CameraModel camera = Camera();
  head::EdgeOperator edge_operator;
  head::FreeModelOptions free_model;
  // The corners in chateau.cao are rounded and in places some tenths of a millimetre beside each other.
  free_model.solver.model_sigma_m = 0.0002;
  free_model.solver.tilt_sigma_m = 0.0001;
  Rng rng(options.seed);
  double shift = 0, turn = 0, seconds = 0;
  int frames = 0, found = 0;
  for (int frame = 1;; ++frame) {
    const auto truth = Truth(frame);
    if (!truth) break;
    const cv::Mat image =
        cv::imread(fmt::format("{}Images/Image_{:04}.pgm", kFolder, frame), cv::IMREAD_GRAYSCALE);
    if (image.empty()) break;
    for (int k = 0; k < (options.quick ? 1 : 10); ++k, ++frames) {
      const Eigen::Isometry3d believed = Disturbed(*truth, kReach_m, kTurn_deg, rng);
      const double start = CpuSeconds();
      head::EdgeImage edges;
      edge_operator.Extract(image, edges);
      const head::CameraView view = head::MakeView(camera, edges);
      const auto fix = head::LocateFreeModel(body, believed, {&view, 1}, free_model);
      seconds += CpuSeconds() - start;
      const Eigen::Isometry3d error = truth->inverse() * fix.base_from_model;
      const double e_mm = 1000 * (fix.base_from_model.translation() - truth->translation()).norm(),
                   e_deg = Degrees(Eigen::AngleAxisd(error.linear()).angle());
      if (options.verbose)
        fmt::print("  frame {} {}: {}, {:.2f} mm {:.3f} deg, {} edges, {:.2f} px, misfit {:.2f}\n", frame, k,
                   head::Describe(fix.verdict), e_mm, e_deg, fix.n_matched, fix.residual_px, fix.misfit);
      if (fix.verdict != head::Verdict::kFound) continue;
      ++found;
      shift += e_mm;
      turn += e_deg;
    }
  }
  figures.AtLeast("  found", 100.0 * found / std::max(1, frames), 90, "%");
  figures.AtMost("  position error, mean", shift / std::max(1, found), 0.8, "mm");
  figures.AtMost("  rotation error, mean", turn / std::max(1, found), 0.2, "deg");
  figures.Note("  time per frame, edges included", 1000 * seconds / std::max(1, frames), "ms");
}

}  // namespace priamos::bench
