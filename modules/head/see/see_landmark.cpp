#include "head/see/see_landmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

using drawing::Colour, drawing::Layer;

constexpr Layer kEdge{"edge", "other edge", {.line = Colour{0x969696}, .width = 0.8}};
constexpr Layer kBelieved{"believed", "model where it is believed", {.line = Colour{0xffffff}, .width = 0.8}};
constexpr Layer kMatched{"matched", "edge taken for the model", {.line = Colour{0x3cdc3c}, .width = 2}};
constexpr Layer kFound{"found", "model where it was found", {.line = Colour{0xff40ff}, .width = 1}};

/// Draws a straight edge as the lens bends it; `p` and `q` are undistorted [px].
void DrawBent(SeePage& page, const CameraModel& camera, const Layer& layer, const Eigen::Vector2d& p,
              const Eigen::Vector2d& q) {
  const bool is_straight = camera.IsRadial() && camera.k1 == 0 && camera.k2 == 0;
  const int pieces = is_straight ? 1 : 12;
  const auto at = [&](int i) { return camera.Distort(p + static_cast<double>(i) / pieces * (q - p)); };
  for (int i = 0; i < pieces; ++i) page.Line(layer, 0, at(i), at(i + 1));
}

void DrawModel(SeePage& page, const CameraView& view, const LandmarkModel& seen, const Eigen::Isometry3d& at,
               const Layer& layer) {
  for (const LandmarkEdge& edge : seen.edges)
    if (const auto p = ProjectEdge(*view.camera, view.size, at * edge.from, at * edge.to))
      DrawBent(page, *view.camera, layer, p->p, p->q);
}

void DrawFound(SeePage& page, const CameraView& view, const FreeModelFix& fix) {
  for (const EdgeMatch& match : fix.matches) {
    if (match.camera != 0) continue;
    for (const int line : match.lines) {
      const EdgeSegment& s = view.edges->segments[view.lines[line].segment];
      page.Line(kMatched, 0, s.begin, s.end);
    }
  }
  DrawModel(page, view, fix.seen, fix.base_from_model, kFound);
}

}  // namespace

SeePage DrawLandmark(const cv::Mat& grey, std::span<const CameraView> views, const Polyhedron& body,
                     const Eigen::Isometry3d& believed, const FreeModelFix& fix) {
  SeePage page(std::span(&grey, 1));
  const CameraView& view = views[0];
  for (const EdgeSegment& s : view.edges->segments) page.Line(kEdge, 0, s.begin, s.end);
  const Eigen::Vector3d eye = believed.inverse() * OpticalCentre(*view.camera);
  DrawModel(page, view, VisibleSkeleton(body, eye), believed, kBelieved);
  if (fix.verdict == Verdict::kFound) DrawFound(page, view, fix);
  page.Finish();
  return page;
}

nlohmann::ordered_json LandmarkToJson(std::span<const CameraView> views, const FreeModelFix& fix) {
  nlohmann::ordered_json json{{"found", fix.verdict == Verdict::kFound}, {"verdict", Describe(fix.verdict)}};
  if (fix.verdict != Verdict::kFound) return json;
  const Eigen::Matrix<double, 6, 1> sigma = fix.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  json["pose_m_deg"] = SixFromPose(fix.base_from_model);
  json["sigma_m"] = {sigma[0], sigma[1], sigma[2]};
  json["sigma_deg"] = {Degrees(sigma[3]), Degrees(sigma[4]), Degrees(sigma[5])};
  json["residual_px"] = fix.residual_px;
  json["misfit"] = fix.misfit;
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
