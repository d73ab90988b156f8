#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "common/geometry.hpp"
#include "head/files/landmark_file.hpp"
#include "test/bench/vision/bodies/body_series.hpp"
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

/// Config/chateau.xml, with the middle of the drawn image where pixels are counted from the centre of the
/// first; the camera's own frame (x right, y down, z forward) is base.
head::CameraModel Camera() {
  head::CameraModel camera;
  camera.image_from_base << 700, 0, 319.5, 0, 0, 700, 239.5, 0, 0, 0, 1, 0;
  camera.centre_px = {319.5, 239.5};
  camera.scale_px = 700;
  return camera;
}

/// The frames with their truths; noise of one grey value makes them pictures of a camera.
std::vector<BodyScene> Frames(double blur_px) {
  std::vector<BodyScene> frames;
  const head::Polyhedron body = head::LoadPolyhedron(std::string(kFolder) + "Models/chateau.cao");
  for (int i = 1;; ++i) {
    const auto truth = Truth(i);
    cv::Mat image = cv::imread(fmt::format("{}Images/Image_{:04}.pgm", kFolder, i), cv::IMREAD_GRAYSCALE);
    if (!truth || image.empty()) return frames;
    if (blur_px > 0) cv::GaussianBlur(image, image, {0, 0}, blur_px);
    frames.push_back({fmt::format("castle {}", i), image, Camera(), body, *truth});
  }
}

}  // namespace

void BenchCastle(const VisionOptions& options, Figures& figures) {
  if (!std::filesystem::exists(kFolder)) {
    fmt::print("ViSP's castle is not here: visp-images-data\n");
    return;
  }
  for (const double blur_px : {0.0, 3.0}) {
    const std::vector<BodyScene> frames = Frames(blur_px);
    for (const BodyStart& start : {kNearStart, kFarStart}) {
      BodyTally tally;
      Rng rng(options.seed);
      for (const BodyScene& frame : frames)
        AddStarts(frame, start, options.quick ? 1 : 5, rng, options.verbose, tally);
      tally.Print(fmt::format("ViSP's castle, blur {:.0f} px, {}", blur_px, start.Words()),
                  {start.success_percent, false}, figures);
    }
  }
}

}  // namespace priamos::bench
