#include "head/files/projection_file.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <stdexcept>
#include <vector>

namespace priamos::head {
namespace {

[[noreturn]] void Fail(const std::string& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file, what));
}

cv::FileStorage Open(const std::string& file) {
  try {
    cv::FileStorage storage(file, cv::FileStorage::READ);
    if (storage.isOpened()) return storage;
  } catch (const cv::Exception&) {
    // OpenCV's own words name its source file, not ours.
  }
  Fail(file, "expected a camera as YAML (first line %YAML:1.0), got none");
}

/// The numbers of `key`.data, which must be `count`.
std::vector<double> Numbers(const std::string& file, const cv::FileStorage& storage, const char* key,
                            std::size_t count) {
  const cv::FileNode data = storage[key]["data"];
  std::vector<double> numbers;
  if (data.isSeq())
    for (const auto& node : data) numbers.push_back(node.isReal() || node.isInt() ? double(node) : NAN);
  if (numbers.size() != count)
    Fail(file, fmt::format("{}: expected data with {} numbers, got {}", key, count, numbers.size()));
  for (const double number : numbers)
    if (!std::isfinite(number)) Fail(file, fmt::format("{}: expected numbers, got something else", key));
  return numbers;
}

void CheckSize(const std::string& file, const cv::FileStorage& storage, int width, int height) {
  const cv::FileNode w = storage["image_width"], h = storage["image_height"];
  if (!w.isInt() || !h.isInt()) Fail(file, "image_width, image_height: expected integers, got none");
  if (int(w) != width || int(h) != height)
    Fail(file, fmt::format("image_width, image_height: expected the image's {}x{}, got {}x{}", width, height,
                           int(w), int(h)));
}

}  // namespace

CameraModel LoadProjection(const std::string& file, int image_width, int image_height) {
  const cv::FileStorage storage = Open(file);
  CheckSize(file, storage, image_width, image_height);
  if (!storage["distortion_coefficients"].empty())
    for (const double k :
         Numbers(file, storage, "distortion_coefficients", storage["distortion_coefficients"]["data"].size()))
      if (k != 0) Fail(file, "distortion_coefficients: expected zeros (rectified photographs), got others");
  const auto p = Numbers(file, storage, "projection_matrix", 12);
  CameraModel camera;
  camera.image_from_base = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(p.data());
  if (!(std::abs(camera.image_from_base.leftCols<3>().determinant()) > 1e-9))
    Fail(file, "projection_matrix: expected a camera, got a singular matrix");
  camera.centre_px = {0.5 * (image_width - 1), 0.5 * (image_height - 1)};
  return camera;
}

}  // namespace priamos::head
