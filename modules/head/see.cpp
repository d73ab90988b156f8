#include "head/see.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "head/core/edge_segments.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 32;
constexpr int kShift = 4;  // cv::line takes sub-pixel points in 1/16 px

cv::Mat ReadGrey(const std::string& file) {
  const cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (image.empty())
    throw std::runtime_error(fmt::format("{}: expected an image (PNG, JPEG, PGM ...), got none", file));
  if (image.cols < kSmallest_px || image.rows < kSmallest_px)
    throw std::runtime_error(fmt::format("{}: expected at least {}x{} pixels, got {}x{}", file, kSmallest_px,
                                         kSmallest_px, image.cols, image.rows));
  return image;
}

cv::Point Fixed(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::lround(p.x() * (1 << kShift))),
          static_cast<int>(std::lround(p.y() * (1 << kShift)))};
}

/// Upright edges green, level ones blue, others orange: a door shows at a glance.
cv::Scalar ColourOf(const EdgeSegment& segment) {
  const Eigen::Vector2d d = segment.direction().cwiseAbs();
  constexpr double kNearlyAxis = 0.1;
  if (d.x() < kNearlyAxis) return {60, 200, 60};
  if (d.y() < kNearlyAxis) return {230, 140, 40};
  return {40, 140, 250};
}

cv::Mat Draw(const cv::Mat& grey, const EdgeImage& edges) {
  cv::Mat canvas;
  cv::cvtColor(grey * 0.6 + 60, canvas, cv::COLOR_GRAY2BGR);
  for (const EdgeSegment& s : edges.segments)
    cv::line(canvas, Fixed(s.begin), Fixed(s.end), ColourOf(s), 2, cv::LINE_AA, kShift);
  return canvas;
}

nlohmann::ordered_json ToJson(const std::string& file, const EdgeImage& edges) {
  auto segments = nlohmann::ordered_json::array();
  for (const EdgeSegment& s : edges.segments) {
    segments.push_back({{"begin_px", {s.begin.x(), s.begin.y()}},
                        {"end_px", {s.end.x(), s.end.y()}},
                        {"sigma_normal_px", s.sigma_normal_px},
                        {"sigma_angle_rad", s.sigma_angle_rad},
                        {"grey_left", s.grey_left},
                        {"grey_right", s.grey_right}});
  }
  return {{"image", file}, {"width_px", edges.width}, {"height_px", edges.height}, {"segments", segments}};
}

}  // namespace

void See(const SeeOptions& options) {
  auto all = nlohmann::ordered_json::array();
  EdgeOperator edge_operator;
  for (const std::string& file : options.images) {
    const cv::Mat grey = ReadGrey(file);
    EdgeImage edges;
    edge_operator.Extract(grey, edges);
    const std::filesystem::path path(file);
    // The folder's name keeps left/50.jpg and right/50.jpg apart.
    const std::string name =
        path.has_parent_path() ? path.parent_path().filename().string() + "-" : std::string();
    const auto drawing = std::filesystem::path(options.folder) / (name + path.stem().string() + "-edges.png");
    if (!cv::imwrite(drawing.string(), Draw(grey, edges)))
      throw std::runtime_error(fmt::format("{}: cannot be written", drawing.string()));
    std::cout << fmt::format("{}: {} segments, drawn in {}\n", file, edges.segments.size(), drawing.string());
    all.push_back(ToJson(file, edges));
  }
  if (options.json.empty()) return;
  std::ofstream out(options.json);
  out << all.dump(1) << "\n";
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", options.json));
}

}  // namespace priamos::head
