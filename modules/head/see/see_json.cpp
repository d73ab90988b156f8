#include "head/see/see_json.hpp"

#include <nlohmann/json.hpp>

namespace priamos::head {
namespace {

using Json = nlohmann::ordered_json;

template <typename Vector>
Json Numbers(const Vector& v) {
  return std::vector<double>(v.data(), v.data() + v.size());
}

Json SegmentsToJson(const EdgeImage& edges) {
  Json list = Json::array();
  for (const EdgeSegment& s : edges.segments)
    list.push_back({{"begin_px", Numbers(s.begin)},
                    {"end_px", Numbers(s.end)},
                    {"sigma_normal_px", s.sigma_normal_px},
                    {"sigma_angle_rad", s.sigma_angle_rad},
                    {"grey_left", s.grey_left},
                    {"grey_right", s.grey_right}});
  return list;
}

Json CornersToJson(const ContourGraph& contours) {
  Json list = Json::array();
  for (const Corner& c : contours.corners())
    list.push_back({{"at_px", Numbers(c.at)},
                    {"covariance_px2",
                     {{c.covariance(0, 0), c.covariance(0, 1)}, {c.covariance(1, 0), c.covariance(1, 1)}}},
                    {"segments", c.segments}});
  return list;
}

Json OutlinesToJson(const ContourGraph& contours) {
  Json list = Json::array();
  for (const Polygon& p : contours.polygons())
    list.push_back({{"segments", p.sides}, {"corners", p.corners}, {"parallelogram", p.is_parallelogram}});
  return list;
}

Json SegmentNumbers(const CameraView& view, const std::vector<int>& lines) {
  Json list = Json::array();
  for (const int line : lines) list.push_back(view.lines[line].segment);
  return list;
}

}  // namespace

Json EdgesToJson(const std::string& file, const EdgeImage& edges, const ContourGraph& contours) {
  return {{"image", file},
          {"width_px", edges.width},
          {"height_px", edges.height},
          {"segments", SegmentsToJson(edges)},
          {"corners", CornersToJson(contours)},
          {"outlines", OutlinesToJson(contours)}};
}

Json MatchesToJson(std::span<const CameraView> views, std::span<const StereoMatch> matches) {
  Json list = Json::array();
  for (const StereoMatch& m : matches) {
    Json match{{"segments", {SegmentNumbers(views[0], {m.left}), SegmentNumbers(views[1], m.right)}},
               {"epipolar_rad", m.epipolar_rad},
               {"similarity", m.similarity}};
    if (views.size() > 2) match["segments"].push_back(SegmentNumbers(views[2], m.third));
    if (m.space) {
      const Eigen::Matrix<double, 6, 1> sigma = m.space->covariance.diagonal().cwiseMax(0).cwiseSqrt();
      match["from_m"] = Numbers(m.space->from);
      match["to_m"] = Numbers(m.space->to);
      match["sigma_from_m"] = Numbers(sigma.head<3>().eval());
      match["sigma_to_m"] = Numbers(sigma.tail<3>().eval());
    }
    list.push_back(match);
  }
  return list;
}

}  // namespace priamos::head
