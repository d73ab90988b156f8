#include "head/files/projection_file.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>
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
    // OpenCV would complain of a file that is not there on standard error.
    if (std::ifstream(file)) {
      cv::FileStorage storage(file, cv::FileStorage::READ);
      if (storage.isOpened() && storage.root().isMap()) return storage;
    }
  } catch (const cv::Exception&) {
    // OpenCV's own words name its source file, not ours.
  }
  Fail(file, "expected a camera as YAML (first line %YAML:1.0), got none");
}

/// Node `key`.data of a file; none where `key` holds something else than a matrix.
cv::FileNode DataOf(const cv::FileStorage& storage, const char* key) {
  const cv::FileNode node = storage[key];
  return node.isMap() ? node["data"] : cv::FileNode();
}

/// The numbers of `key`.data, which must be `count`.
std::vector<double> Numbers(const std::string& file, const cv::FileStorage& storage, const char* key,
                            std::size_t count) {
  const cv::FileNode data = DataOf(storage, key);
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

void CheckRectified(const std::string& file, const cv::FileStorage& storage) {
  constexpr const char* kKey = "distortion_coefficients";
  if (storage[kKey].empty()) return;
  const std::size_t count = DataOf(storage, kKey).size();
  if (count == 0) Fail(file, fmt::format("{}: expected data with numbers, got none", kKey));
  for (const double k : Numbers(file, storage, kKey, count))
    if (k != 0) Fail(file, fmt::format("{}: expected zeros (rectified photographs), got others", kKey));
}

}  // namespace

CameraModel LoadProjection(const std::string& file, int image_width, int image_height) {
  const cv::FileStorage storage = Open(file);
  CheckSize(file, storage, image_width, image_height);
  CheckRectified(file, storage);
  const auto p = Numbers(file, storage, "projection_matrix", 12);
  CameraModel camera;
  camera.image_from_base = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(p.data());
  if (!(std::abs(camera.image_from_base.leftCols<3>().determinant()) > 1e-9))
    Fail(file, "projection_matrix: expected a camera, got a singular matrix");
  camera.centre_px = {0.5 * (image_width - 1), 0.5 * (image_height - 1)};
  return camera;
}

}  // namespace priamos::head
