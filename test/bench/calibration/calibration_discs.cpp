// The error of a disc's centre: ours beside OpenCV's and, where it is installed, ViSP's, on the same images.
#include <fmt/format.h>

#include <functional>
#include <opencv2/features2d.hpp>
#include <optional>

#include "common/geometry.hpp"
#include "head/core/calibration/discs/disc_detection.hpp"
#include "test/bench/calibration/calibration_bench.hpp"
#include "test/bench/calibration/visp_dot.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::bench {
namespace {

using namespace head;
using Eigen::Vector2d;

constexpr int kSize_px = 96;

/// Finds the one disc of an image.
using Detector = std::function<std::optional<Vector2d>(const GreyImage&)>;

std::optional<Vector2d> Ours(const GreyImage& image) {
  const auto found = DetectDiscs(image);
  if (found.size() != 1) return std::nullopt;
  return found[0].ellipse.centre_px;
}

/// The weighted centroid of the paper, background subtracted: our own first step.
std::optional<Vector2d> Centroid(const GreyImage& image) {
  const auto found = DetectDiscs(image);
  if (found.size() != 1) return std::nullopt;
  const auto moments = MeasureMoments(image, found[0].ellipse);
  if (!moments) return std::nullopt;
  return moments->ellipse.centre_px;
}

std::optional<Vector2d> OpenCv(const GreyImage& image) {
  cv::SimpleBlobDetector::Params params;
  params.filterByColor = true;
  params.blobColor = 255;
  params.filterByArea = true;
  params.minArea = 50;
  params.maxArea = 5000;
  params.filterByCircularity = params.filterByConvexity = params.filterByInertia = false;
  const cv::Mat view(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<cv::KeyPoint> found;
  cv::SimpleBlobDetector::create(params)->detect(view, found);
  if (found.size() != 1) return std::nullopt;
  return Vector2d(found[0].pt.x, found[0].pt.y);
}

std::optional<Vector2d> Visp(const GreyImage& image) {
  return VispDot({image.pixels.data(), image.width, image.height}, kSize_px / 2.0, kSize_px / 2.0);
}

struct Rival {
  const char* name;
  Detector detect;
  bool corrected;  ///< by the eccentricity, which only we know of
  double squares = 0;
  int missed = 0;
};

std::vector<Rival> Rivals() {
  std::vector<Rival> rivals{{"ours", Ours, true},
                            {"  ours, eccentricity left in", Ours, false},
                            {"  the paper's weighted centroid", Centroid, false},
                            {"  OpenCV SimpleBlobDetector", OpenCv, false}};
  if (kHaveVisp) rivals.push_back({"  ViSP vpDot2", Visp, false});
  return rivals;
}

/// Lets everybody measure the same images of a disc of `radius_px` at `tilt_rad`.
void Compete(std::vector<Rival>& rivals, int samples, double radius_px, double tilt_rad, Rng& rng) {
  for (int i = 0; i < samples; ++i) {
    support::CameraView view;
    view.focal_px = 1200;
    view.distance_m = 1.5;
    view.azimuth_rad = tilt_rad;
    view.roll_rad = rng.Uniform(0, kPi);
    view.target_m = {0, 0, 0};
    view.centre_px = {kSize_px / 2 + rng.Uniform(-0.5, 0.5), kSize_px / 2 + rng.Uniform(-0.5, 0.5)};
    const CameraModel camera = support::MakeCamera(view);
    const ReferenceDisc disc{{0, 0, 0}, {1, 0, 0}, radius_px * view.distance_m / view.focal_px};
    support::DiscRenderer scene(kSize_px, kSize_px, 20, 3);
    scene.AddDisc(camera, disc, 200);
    const GreyImage image = scene.Expose({0.7, 2}, rng);
    const Vector2d truth = camera.Project(disc.centre_m), bias = CentroidBias(camera, disc);
    for (Rival& rival : rivals) {
      const auto found = rival.detect(image);
      rival.missed += !found;
      if (!found) continue;
      rival.squares += (*found - (rival.corrected ? bias : Vector2d::Zero()) - truth).squaredNorm();
    }
  }
}

void Measure(const char* what, int samples, double radius_px, double tilt_rad, double bound, Rng rng,
             Figures& figures) {
  std::vector<Rival> rivals = Rivals();
  Compete(rivals, samples, radius_px, tilt_rad, rng);
  for (const Rival& r : rivals) {
    const double rms = std::sqrt(r.squares / std::max(1, samples - r.missed));
    const std::string missed = r.missed ? fmt::format(", {} not found", r.missed) : "";
    if (&r == &rivals.front())
      figures.AtMost(fmt::format("{}: RMS{}", what, missed), r.missed ? 1e9 : rms, bound, "px");
    else
      figures.Note(r.name + missed, rms, "px");
  }
}

}  // namespace

void BenchDiscs(const CalibrationOptions& options, Figures& figures) {
  Measure("disc centre, front view, r = 8 px, noise 2", 2000 / options.scale, 8, 0, 0.0075,
          options.Stream("front"), figures);
  Measure("disc centre, 45 degrees, r = 16 px, noise 2", 1000 / options.scale, 16, Radians(45), 0.015,
          options.Stream("slanted"), figures);
}

}  // namespace priamos::bench
