#include "test/support/line_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "common/geometry.hpp"

namespace priamos::test {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

/// The part of `polygon` with normal.dot(p) <= limit.
Polygon Clip(const Polygon& polygon, const Eigen::Vector2d& normal, double limit) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double fa = normal.dot(a) - limit, fb = normal.dot(b) - limit;
    if (fa <= 0) result.push_back(a);
    if (fa * fb < 0) result.push_back(a + (b - a) * (fa / (fa - fb)));
  }
  return result;
}

double Area(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(sum) / 2;
}

struct Rectangle {
  Eigen::Vector2d centre, along, across;
  double half_length, half_width;

  double CoverOf(int x, int y) const {
    const Eigen::Vector2d d = Eigen::Vector2d(x, y) - centre;
    const double u = std::abs(along.dot(d)) - half_length, v = std::abs(across.dot(d)) - half_width;
    if (u > 0.8 || v > 0.8) return 0;
    if (u < -0.8 && v < -0.8) return 1;
    Polygon pixel{{x - 0.5, y - 0.5}, {x + 0.5, y - 0.5}, {x + 0.5, y + 0.5}, {x - 0.5, y + 0.5}};
    for (const double sign : {-1.0, 1.0}) {
      pixel = Clip(pixel, sign * along, sign * along.dot(centre) + half_length);
      pixel = Clip(pixel, sign * across, sign * across.dot(centre) + half_width);
    }
    return pixel.empty() ? 0 : Area(pixel);
  }
};

/// True if the segment begins on one line and ends on another.
bool TouchesTwo(const std::vector<TrueLine>& lines, const head::EdgeSegment& segment) {
  const auto line_at = [&](const Eigen::Vector2d& p) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Eigen::Vector2d direction = lines[i].end - lines[i].begin, d = direction.normalized();
      const double along = d.dot(p - lines[i].begin);
      const double beside = std::abs(d.x() * (p - lines[i].begin).y() - d.y() * (p - lines[i].begin).x());
      if (beside < 2 && along > -2 && along < direction.norm() + 2) return static_cast<int>(i);
    }
    return -1;
  };
  const int first = line_at(segment.begin), second = line_at(segment.end);
  return first >= 0 && second >= 0 && first != second;
}

}  // namespace

LineScene RandomRectangles(double contrast, double noise, double blur_px, Rng& rng) {
  constexpr int kWidth = 768, kHeight = 576, kColumns = 4, kRows = 3;
  constexpr double kGround = 128;
  LineScene scene;
  cv::Mat light(kHeight, kWidth, CV_32FC1, cv::Scalar(kGround));
  for (int cell = 0; cell < kColumns * kRows; ++cell) {
    const double angle = rng.Uniform(0, kPi);
    Rectangle r;
    r.centre = {(cell % kColumns + 0.5) * kWidth / kColumns, (cell / kColumns + 0.5) * kHeight / kRows};
    r.centre += Eigen::Vector2d(rng.Uniform(-8, 8), rng.Uniform(-8, 8));
    r.along = {std::cos(angle), std::sin(angle)};
    r.across = {-r.along.y(), r.along.x()};
    r.half_length = rng.Uniform(30, 75);
    r.half_width = rng.Uniform(20, 40);
    const double step = rng.Chance(0.5) ? contrast : -contrast;
    constexpr int kReach = 90;
    for (int y = std::max(0, int(r.centre.y()) - kReach); y < std::min(kHeight, int(r.centre.y()) + kReach);
         ++y) {
      for (int x = std::max(0, int(r.centre.x()) - kReach); x < std::min(kWidth, int(r.centre.x()) + kReach);
           ++x) {
        light.at<float>(y, x) += static_cast<float>(step * r.CoverOf(x, y));
      }
    }
    const Eigen::Vector2d a = r.half_length * r.along, b = r.half_width * r.across, &c = r.centre;
    const Eigen::Vector2d corners[4] = {c - a - b, c + a - b, c + a + b, c - a + b};
    for (int k = 0; k < 4; ++k) scene.lines.push_back({corners[k], corners[(k + 1) % 4]});
  }
  if (blur_px > 0) cv::GaussianBlur(light, light, {}, blur_px);
  scene.image.create(kHeight, kWidth, CV_8UC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      scene.image.at<unsigned char>(y, x) =
          cv::saturate_cast<unsigned char>(light.at<float>(y, x) + rng.Normal(noise));
    }
  }
  return scene;
}

void LineScorer::Add(const std::vector<TrueLine>& lines, const std::vector<head::EdgeSegment>& segments) {
  constexpr double kNear_px = 2, kEnd_px = 2, kOverlong_px = 8;
  std::vector<bool> used(segments.size(), false);
  for (const TrueLine& line : lines) {
    const double length = (line.end - line.begin).norm();
    const Eigen::Vector2d d = (line.end - line.begin) / length, n(-d.y(), d.x());
    std::vector<std::pair<double, double>> parts;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const head::EdgeSegment& s = segments[i];
      const double a = n.dot(s.begin - line.begin), b = n.dot(s.end - line.begin);
      double from = d.dot(s.begin - line.begin), to = d.dot(s.end - line.begin);
      if (from > to) std::swap(from, to);
      if (std::abs(a) > kNear_px || std::abs(b) > kNear_px || to < kEnd_px || from > length - kEnd_px)
        continue;
      used[i] = true;
      n_overlong_ += from < -kOverlong_px || to > length + kOverlong_px;
      errors_.push_back(std::abs(a));
      errors_.push_back(std::abs(b));
      const double along = d.dot(s.centre - line.begin), error = n.dot(s.centre - line.begin);
      if (along > 0 && along < length) nees_ += error * error / (s.sigma_normal_px * s.sigma_normal_px);
      parts.emplace_back(std::max(from, 0.0), std::min(to, length));
    }
    std::sort(parts.begin(), parts.end());
    double end = 0;
    for (const auto& [from, to] : parts) {
      covered_ += std::max(0.0, to - std::max(from, end));
      end = std::max(end, to);
    }
    length_ += length;
    ++n_lines_;
    n_found_ += !parts.empty();
    n_broken_ += parts.size() > 1;
    n_pieces_ += static_cast<int>(parts.size());
  }
  const int n_outliers = static_cast<int>(std::count(used.begin(), used.end(), false));
  n_false_ += n_outliers;
  n_segments_ += static_cast<int>(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) n_overlong_ += !used[i] && TouchesTwo(lines, segments[i]);
}

LineScore LineScorer::Score() const {
  LineScore score;
  score.end_errors_px = errors_;
  if (errors_.empty()) return score;
  score.mean_error_px = std::accumulate(errors_.begin(), errors_.end(), 0.0) / errors_.size();
  score.coverage = covered_ / length_;
  score.broken = double(n_broken_) / n_lines_;
  score.pieces = double(n_pieces_) / n_found_;
  score.n_false = n_false_;
  score.wrong_unions = double(n_overlong_) / n_segments_;
  score.nees = nees_ / n_pieces_;
  return score;
}

}  // namespace priamos::test
