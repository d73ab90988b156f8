#include <fmt/format.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/edges/equal_contrast.hpp"
#include "head/core/stereo/edge_stereo.hpp"
#include "head/files/camera_file.hpp"
#include "test/bench/vision/photometry/door_light.hpp"
#include "test/bench/vision/photometry/other_light.hpp"
#include "test/bench/vision/stereo_scenes.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

/// Judges a match of two views.
using IsRight = std::function<bool(const head::CameraView&, int, const head::CameraView&, int)>;

struct Scene {
  std::vector<cv::Mat> images;
  std::vector<head::CameraModel> cameras;
  IsRight is_right;
};

struct Count {
  int right = 0, wrong = 0;
  std::size_t lines = 0;  ///< of the second image
  double seconds = 0;
};

/// Matches of a scene when the first image, or all others, are seen in another light.
void Add(const Scene& scene, const OtherLight& light, Count& count) {
  const std::size_t n = scene.images.size();
  std::vector<head::EdgeImage> edges(n);
  std::vector<head::CameraView> views;
  std::vector<cv::Mat> images = scene.images;
  for (std::size_t c = 0; c < n; ++c)
    if ((c == 0) == light.of_first) images[c] = light.Of(images[c]);
  const auto options = head::ForOneScene(images, {});
  for (std::size_t c = 0; c < n; ++c) {
    head::EdgeOperator(options[c]).Extract(images[c], edges[c]);
    views.push_back(head::MakeView(scene.cameras[c], edges[c]));
  }
  count.lines += views[1].lines.size();
  const double start = CpuSeconds();
  const auto matches = n == 2 ? head::MatchBinocular(views[0], views[1], {})
                              : head::MatchTrinocular(views[0], views[1], views[2], {});
  count.seconds += CpuSeconds() - start;
  for (const head::StereoMatch& m : matches)
    if (m.space) (scene.is_right(views[0], m.left, views[1], m.right.front()) ? count.right : count.wrong)++;
}

void Report(const std::vector<Scene>& scenes, Figures& figures) {
  int at_first = 0;
  for (const OtherLight& light : AllLights()) {
    Count count;
    for (const Scene& scene : scenes) Add(scene, light, count);
    if (at_first == 0) at_first = count.right;
    fmt::print("  {:38} right {:6} wrong {:5} ({:.1f} %), lines {:6}, {:.2f} ms\n", light.name, count.right,
               count.wrong, 100.0 * count.wrong / std::max(1, count.right + count.wrong), count.lines,
               1000 * count.seconds / static_cast<double>(scenes.size()));
    figures.AtLeast("  right, of those of equal cameras", double(count.right) / std::max(1, at_first), 0.9,
                    "");
  }
}

/// Dense disparity of a rectified pair, by OpenCV's semi-global matching: it knows nothing of edges.
cv::Mat Disparity(const cv::Mat& left, const cv::Mat& right) {
  const auto matcher = cv::StereoSGBM::create(0, 128, 7, 8 * 49, 32 * 49, 1, 63, 10, 100, 2);
  cv::Mat fixed, disparity;
  matcher->compute(left, right, fixed);
  fixed.convertTo(disparity, CV_32F, 1.0 / 16);
  return disparity;
}

/// Whether the disparity of two lines is that of what lies on either side of the left one.
bool HasDisparity(const cv::Mat& disparity, const head::ViewLine& a, const head::ViewLine& b) {
  constexpr double kReach_px = 2;
  int agree = 0, known = 0;
  for (const double part : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
    const Eigen::Vector2d at = a.p + part * (a.q - a.p);
    if (std::abs(b.normal.x()) < 0.05) return false;
    const double x = b.p.x() - (at.y() - b.p.y()) * b.normal.y() / b.normal.x();
    for (const double side : {-5.0, -2.5, 0.0, 2.5, 5.0}) {
      const Eigen::Vector2d beside = at + side * a.normal;
      const cv::Point pixel(static_cast<int>(beside.x()), static_cast<int>(beside.y()));
      if (!cv::Rect({}, disparity.size()).contains(pixel)) continue;
      const double d = disparity.at<float>(pixel);
      if (d < 0) continue;
      ++known;
      if (std::abs(at.x() - x - d) < kReach_px) {
        ++agree;
        break;
      }
    }
  }
  return known > 0 && agree >= 4;
}

std::vector<Scene> Photographs(const VisionOptions& options) {
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i + 3 < options.pairs.size(); i += 4) {
    Scene& scene = scenes.emplace_back();
    for (std::size_t c = 0; c < 2; ++c) {
      scene.images.push_back(cv::imread(options.pairs[i + c], cv::IMREAD_GRAYSCALE));
      scene.cameras.push_back(head::LoadCameras({options.pairs[i + 2 + c]}, 1,
                                                {{scene.images[c].cols, scene.images[c].rows}, true})
                                  .front());
    }
    const cv::Mat disparity = Disparity(scene.images[0], scene.images[1]);
    scene.is_right = [disparity](const head::CameraView& left, int a, const head::CameraView& right, int b) {
      return HasDisparity(disparity, left.lines[a], right.lines[b]);
    };
  }
  return scenes;
}

std::vector<Scene> Rendered(StereoScene kind, int n_cameras, const VisionOptions& options) {
  StereoStage stage;
  std::vector<Scene> scenes;
  for (int i = 0; i < (options.quick ? 5 : 30); ++i) {
    const auto triple = std::make_shared<StereoTriple>(stage.Take(kind, options.seed + i));
    Scene& scene = scenes.emplace_back();
    scene.images.assign(triple->images.begin(), triple->images.begin() + n_cameras);
    scene.cameras.assign(triple->cameras.begin(), triple->cameras.begin() + n_cameras);
    scene.is_right = [triple](const head::CameraView& left, int a, const head::CameraView& right, int b) {
      return triple->IsSameEdge(left, a, right, b);
    };
  }
  return scenes;
}

}  // namespace

void BenchPhotometry(const VisionOptions& options, Figures& figures) {
  BenchDoorLight(options, figures);
  if (!options.pairs.empty()) {
    fmt::print("photographs, judged by semi-global matching of the pair as it is\n");
    Report(Photographs(options), figures);
  }
  for (const StereoScene kind : {StereoScene::kDoorRoom, StereoScene::kBoxes})
    for (const int n_cameras : {2, 3}) {
      fmt::print("rendered: {}, {} cameras\n", Describe(kind), n_cameras);
      Report(Rendered(kind, n_cameras, options), figures);
    }
}

}  // namespace priamos::bench
