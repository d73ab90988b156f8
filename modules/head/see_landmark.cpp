#include "head/see_landmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "head/core/projection.hpp"

namespace priamos::head {
namespace {

constexpr int kShift = 4;  // OpenCV takes sub-pixel points in 1/16 px

void Line(cv::Mat& canvas, const Eigen::Vector2d& p, const Eigen::Vector2d& q, const cv::Scalar& colour,
          int width) {
  const auto fixed = [](const Eigen::Vector2d& at) {
    return cv::Point(static_cast<int>(std::lround(at.x() * (1 << kShift))),
                     static_cast<int>(std::lround(at.y() * (1 << kShift))));
  };
  cv::line(canvas, fixed(p), fixed(q), colour, width, cv::LINE_AA, kShift);
}

void DrawModel(cv::Mat& canvas, const CameraView& view, const LandmarkModel& seen,
               const Eigen::Isometry3d& at, const cv::Scalar& colour) {
  for (const LandmarkEdge& edge : seen.edges)
    if (const auto p = ProjectEdge(*view.camera, view.size, at * edge.from, at * edge.to))
      Line(canvas, p->p, p->q, colour, 1);
}

}  // namespace

cv::Mat DrawLandmark(const cv::Mat& grey, std::span<const CameraView> views, const Polyhedron& body,
                     const Eigen::Isometry3d& believed, const FreeModelFix& fix) {
  cv::Mat canvas;
  cv::cvtColor(grey * 0.6 + 30, canvas, cv::COLOR_GRAY2BGR);
  const CameraView& view = views[0];
  for (const EdgeSegment& s : view.edges->segments) Line(canvas, s.begin, s.end, {150, 150, 150}, 1);
  const Eigen::Vector3d eye = believed.inverse() * OpticalCentre(*view.camera);
  DrawModel(canvas, view, VisibleSkeleton(body, eye), believed, {255, 255, 255});
  if (fix.verdict != Verdict::kFound) return canvas;
  for (const EdgeMatch& match : fix.matches) {
    if (match.camera != 0) continue;
    for (const int line : match.lines) {
      const EdgeSegment& s = view.edges->segments[view.lines[line].segment];
      Line(canvas, s.begin, s.end, {60, 220, 60}, 2);
    }
  }
  DrawModel(canvas, view, fix.seen, fix.base_from_model, {255, 0, 255});
  return canvas;
}

nlohmann::ordered_json LandmarkToJson(std::span<const CameraView> views, const FreeModelFix& fix) {
  nlohmann::ordered_json json{{"found", fix.verdict == Verdict::kFound}, {"verdict", Describe(fix.verdict)}};
  if (fix.verdict != Verdict::kFound) return json;
  const Eigen::Matrix<double, 6, 1> sigma = fix.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  json["pose_m_deg"] = SixFromPose(fix.base_from_model);
  json["sigma_m"] = {sigma[0], sigma[1], sigma[2]};
  json["sigma_deg"] = {Degrees(sigma[3]), Degrees(sigma[4]), Degrees(sigma[5])};
  json["residual_px"] = fix.residual_px, json["misfit"] = fix.misfit;
  auto matches = nlohmann::ordered_json::array();
  for (const EdgeMatch& match : fix.matches) {
    const LandmarkEdge& edge = fix.seen.edges[match.edge];
    std::vector<int> segments;
    for (const int line : match.lines) segments.push_back(views[match.camera].lines[line].segment);
    matches.push_back({{"image", match.camera},
                       {"from_m", std::vector<double>(edge.from.begin(), edge.from.end())},
                       {"to_m", std::vector<double>(edge.to.begin(), edge.to.end())},
                       {"segments", segments}});
  }
  json["matches"] = matches;
  return json;
}

Eigen::Isometry3d PoseFromSix(const std::vector<double>& n) {
  if (n.size() != 6 || !std::all_of(n.begin(), n.end(), [](double v) { return std::isfinite(v); }))
    throw std::runtime_error("expected six finite numbers: x y z [m] roll pitch yaw [deg]");
  using Eigen::AngleAxisd, Eigen::Vector3d;
  Eigen::Isometry3d pose(Eigen::Translation3d(n[0], n[1], n[2]));
  pose.rotate(AngleAxisd(Radians(n[5]), Vector3d::UnitZ()) * AngleAxisd(Radians(n[4]), Vector3d::UnitY()) *
              AngleAxisd(Radians(n[3]), Vector3d::UnitX()));
  return pose;
}

std::array<double, 6> SixFromPose(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d r = pose.linear();
  const Eigen::Vector3d t = pose.translation();
  return {t.x(),
          t.y(),
          t.z(),
          Degrees(std::atan2(r(2, 1), r(2, 2))),
          Degrees(-std::asin(std::clamp(r(2, 0), -1.0, 1.0))),
          Degrees(std::atan2(r(1, 0), r(0, 0)))};
}

}  // namespace priamos::head
