#include "test/bench/vision/order/order_pairs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "head/files/camera_file.hpp"
#include "test/bench/vision/stereo_scenes.hpp"

namespace priamos::bench {
namespace {

constexpr const char* kOpenCv = "/usr/share/doc/opencv-doc/examples/data";
constexpr double kSquare_m = 0.025;

head::CameraModel ToModel(const cv::Mat& projection, cv::Size size) {
  head::CameraModel camera;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) camera.image_from_base(r, c) = projection.at<double>(r, c);
  camera.centre_px = {(size.width - 1) / 2.0, (size.height - 1) / 2.0};
  return camera;
}

cv::Mat Projection(double focal_px, cv::Size size, double baseline_m) {
  return (cv::Mat_<double>(3, 4) << focal_px, 0, size.width / 2.0, -focal_px * baseline_m, 0, focal_px,
          size.height / 2.0, 0, 0, 0, 1, 0);
}

/// The photographs of the chessboard, with the corners in each.
struct Boards {
  std::vector<std::array<cv::Mat, 2>> images;
  std::array<std::vector<std::vector<cv::Point2f>>, 2> corners;

  void Add(int number) {
    std::array<cv::Mat, 2> pair;
    std::array<std::vector<cv::Point2f>, 2> found;
    for (int c = 0; c < 2; ++c) {
      pair[c] = cv::imread(fmt::format("{}/{}{:02}.jpg", kOpenCv, c == 0 ? "left" : "right", number),
                           cv::IMREAD_GRAYSCALE);
      if (pair[c].empty() || !cv::findChessboardCorners(pair[c], {9, 6}, found[c])) return;
      cv::cornerSubPix(pair[c], found[c], {5, 5}, {-1, -1}, {3, 30, 0.01});
    }
    images.push_back(pair);
    for (int c = 0; c < 2; ++c) corners[c].push_back(found[c]);
  }
};

std::vector<std::pair<std::string, OrderPair>> Chessboards() {
  Boards boards;
  for (int number = 1; number <= 14; ++number) boards.Add(number);
  if (boards.images.size() < 5) return {};
  const cv::Size size = boards.images[0][0].size();
  std::vector<cv::Point3f> board;
  for (int i = 0; i < 54; ++i)
    board.emplace_back(static_cast<float>(kSquare_m * (i % 9)), static_cast<float>(kSquare_m * (i / 9)), 0.f);
  const std::vector<std::vector<cv::Point3f>> points(boards.images.size(), board);
  cv::Mat k[2], d[2], rotation, translation, e, f, r[2], p[2], q;
  for (int c = 0; c < 2; ++c)
    cv::calibrateCamera(points, boards.corners[c], size, k[c], d[c], cv::noArray(), cv::noArray());
  cv::stereoCalibrate(points, boards.corners[0], boards.corners[1], k[0], d[0], k[1], d[1], size, rotation,
                      translation, e, f);
  cv::stereoRectify(k[0], d[0], k[1], d[1], size, rotation, translation, r[0], r[1], p[0], p[1], q,
                    cv::CALIB_ZERO_DISPARITY, 0);
  std::vector<std::pair<std::string, OrderPair>> pairs;
  for (const auto& images : boards.images) {
    auto& [name, pair] = pairs.emplace_back();
    name = "chessboards";
    for (int c = 0; c < 2; ++c) {
      cv::Mat x, y;
      cv::initUndistortRectifyMap(k[c], d[c], r[c], p[c], size, CV_32FC1, x, y);
      cv::remap(images[c], pair.images[c], x, y, cv::INTER_CUBIC);
      pair.cameras[c] = ToModel(p[c], size);
    }
  }
  return pairs;
}

/// Middlebury's aloe at half its size: 3740 px and 0.16 m at the full one; the nearest leaves are 2.2 m away.
std::vector<std::pair<std::string, OrderPair>> Aloe() {
  std::vector<std::pair<std::string, OrderPair>> pairs;
  OrderPair pair;
  for (int c = 0; c < 2; ++c) {
    const cv::Mat image =
        cv::imread(fmt::format("{}/aloe{}.jpg", kOpenCv, c == 0 ? "L" : "R"), cv::IMREAD_GRAYSCALE);
    if (image.empty()) return {};
    cv::resize(image, pair.images[c], {}, 0.5, 0.5, cv::INTER_AREA);
    pair.cameras[c] = ToModel(Projection(1870, pair.images[c].size(), c * 0.16), pair.images[c].size());
  }
  pairs.emplace_back("aloe", pair);
  return pairs;
}

}  // namespace

void ForEachRendered(const VisionOptions& options, int n,
                     const std::function<void(const char* kind, const OrderPair&)>& visit) {
  StereoStage stage;
  for (const StereoScene kind : kStereoScenes)
    for (int i = 0; i < n; ++i) {
      const StereoTriple triple = stage.Take(kind, options.seed + i);
      visit(Describe(kind), {{triple.images[0], triple.images[1]}, {triple.cameras[0], triple.cameras[1]}});
    }
}

std::vector<std::pair<std::string, OrderPair>> PhotographedPairs(const VisionOptions& options) {
  auto pairs = Chessboards();
  for (auto& pair : Aloe()) pairs.push_back(std::move(pair));
  for (std::size_t i = 0; i + 3 < options.pairs.size(); i += 4) {
    auto& [name, pair] = pairs.emplace_back();
    name = "--pair";
    for (std::size_t c = 0; c < 2; ++c) {
      pair.images[c] = cv::imread(options.pairs[i + c], cv::IMREAD_GRAYSCALE);
      pair.cameras[c] =
          head::LoadCameras({options.pairs[i + 2 + c]}, 1, {{pair.images[c].cols, pair.images[c].rows}, true})
              .front();
    }
  }
  return pairs;
}

}  // namespace priamos::bench
