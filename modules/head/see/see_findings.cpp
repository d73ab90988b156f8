#include "head/see/see_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "head/core/edges/equal_contrast.hpp"
#include "head/core/edges/scale_edges.hpp"
#include "head/files/image_file.hpp"
#include "head/files/landmark_file.hpp"
#include "head/files/projection_file.hpp"
#include "head/see/see_doors.hpp"
#include "head/see/see_landmark.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 32;
constexpr double kBlurred =
    0.75;  // a sharp photograph shows at half its size less than this part of its edges
constexpr double kFarthestDoor_m = 12;  // nobody drives by these: far ones may be uncertain

cv::Mat ReadLargeEnough(const std::string& file) {
  cv::Mat image = ReadGrey(file);
  if (image.empty())
    throw std::runtime_error(fmt::format("{}: expected an image (PNG, JPEG, PGM ...), got none", file));
  if (image.cols < kSmallest_px || image.rows < kSmallest_px)
    throw std::runtime_error(fmt::format("{}: expected at least {}x{} pixels, got {}x{}", file, kSmallest_px,
                                         kSmallest_px, image.cols, image.rows));
  return image;
}

double LengthOf(const EdgeImage& image) {
  double length_px = 0;
  for (const EdgeSegment& segment : image.segments) length_px += segment.length_px();
  return length_px;
}

/// An image that at half its size shows nearly all of its edges, or more, is soft and is seen over scales.
EdgeImage EdgesOf(const cv::Mat& grey, const EdgeOperator::Options& options) {
  EdgeOperator edge_operator(options);
  EdgeImage edges, of_half;
  edge_operator.Extract(grey, edges);
  if (std::min(grey.cols, grey.rows) < 2 * kSmallest_px) return edges;
  cv::Mat half;
  cv::resize(grey, half, {}, 0.5, 0.5, cv::INTER_AREA);
  edge_operator.Extract(half, of_half);
  const double length_px = LengthOf(edges);
  if (length_px > 0 && 2 * LengthOf(of_half) <= kBlurred * length_px) return edges;
  BlurredEdges blurred;
  ScaleEdgeOperator(options).Extract(grey, blurred);
  return blurred.edges;
}

std::vector<cv::Mat> GreysOf(const std::vector<SeenPhotograph>& photographs) {
  std::vector<cv::Mat> greys;
  greys.reserve(photographs.size());
  for (const SeenPhotograph& photograph : photographs) greys.push_back(photograph.grey);
  return greys;
}

/// With cameras all show one scene, and one that is darker is searched for weaker edges.
void FindEdges(bool of_one_scene, std::vector<SeenPhotograph>& photographs) {
  std::vector<EdgeOperator::Options> options(photographs.size());
  if (of_one_scene) options = ForOneScene(GreysOf(photographs), {});
  for (std::size_t i = 0; i < photographs.size(); ++i)
    photographs[i].edges = EdgesOf(photographs[i].grey, options[i]);
  for (SeenPhotograph& photograph : photographs) photograph.contours = {photograph.edges, {}};
}

std::vector<SeenPhotograph> ReadPhotographs(const SeeOptions& options) {
  std::vector<SeenPhotograph> photographs;
  for (const std::string& file : options.images) {
    SeenPhotograph& photograph = photographs.emplace_back();
    photograph.file = file;
    photograph.grey = ReadLargeEnough(file);
  }
  FindEdges(!options.cameras.empty(), photographs);
  return photographs;
}

std::vector<CameraModel> ReadCameras(const SeeOptions& options,
                                     const std::vector<SeenPhotograph>& photographs) {
  if (options.cameras.empty()) return {};
  const std::size_t n = photographs.size();
  const std::size_t fewest = options.landmark.empty() ? 2 : 1;
  if (options.cameras.size() != n || n < fewest || n > 3)
    throw std::runtime_error(fmt::format("expected {} images and a camera for each, got {} and {}",
                                         fewest == 1 ? "one to three" : "two or three", n,
                                         options.cameras.size()));
  std::vector<CameraModel> cameras;
  for (std::size_t i = 0; i < n; ++i) {
    const cv::Mat& grey = photographs[i].grey;
    if (grey.size() != photographs[0].grey.size())
      throw std::runtime_error(fmt::format("{}: expected the size of {}, got {}x{}", photographs[i].file,
                                           photographs[0].file, grey.cols, grey.rows));
    cameras.push_back(LoadProjection(options.cameras[i], grey.cols, grey.rows));
  }
  return cameras;
}

/// Two cameras never agree in every pixel; of one image seen twice, chance matches would pass for edges in
/// space.
void RefuseSameImage(const std::vector<SeenPhotograph>& photographs) {
  for (std::size_t i = 0; i < photographs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cv::norm(photographs[i].grey, photographs[j].grey, cv::NORM_INF) == 0)
        throw std::runtime_error(
            fmt::format("{} and {}: expected an image of each camera, got the same image twice",
                        photographs[j].file, photographs[i].file));
}

/// Seen from the wrong side everything lies behind the cameras, or nothing fits.
void RefuseExchanged(const SeeFindings& findings, int n_as_given) {
  const SeenPhotograph &first = findings.photographs[0], &second = findings.photographs[1];
  const int exchanged =
      CountInSpace(MatchBinocular(MakeView(findings.cameras[0], second.edges),
                                  MakeView(findings.cameras[1], first.edges), StereoOptions()));
  if (exchanged >= 2 && exchanged > 3 * n_as_given)
    throw std::runtime_error(
        fmt::format("{} and {}: expected the images in the order of their cameras: {} edges fit as they "
                    "are, {} if the images are exchanged",
                    first.file, second.file, n_as_given, exchanged));
}

std::vector<StereoMatch> MatchViews(const SeeFindings& findings) {
  const auto& views = findings.views;
  auto matches = views.size() == 2 ? MatchBinocular(views[0], views[1], {})
                                   : MatchTrinocular(views[0], views[1], views[2], {});
  RefuseExchanged(findings, CountInSpace(matches));
  return matches;
}

DoorDetectionOptions DoorOptions(double max_width_m) {
  DoorDetectionOptions options;
  options.stereo.max_range_m = kFarthestDoor_m;
  if (const double wider_m = max_width_m - options.max_width_m; wider_m > 0) {  // one leaf or two
    options.width_sigma_m += wider_m / 2;
    options.usual_width_m += wider_m / 2;
  }
  options.max_width_m = max_width_m;
  return options;
}

SeenDoors FindDoors(const SeeOptions& options, const SeeFindings& findings) {
  if (findings.cameras.size() != 2)
    throw std::runtime_error(fmt::format("expected two images and their cameras to look for doors, got {}",
                                         findings.cameras.size()));
  SeenDoors seen{OnTheFloor(findings.cameras, options.stand), std::vector<EdgeImage>(2), {}, {}};
  const auto edge_options = ForOneScene(findings.Greys(), DoorEdges());
  for (int c = 0; c < 2; ++c) {
    EdgeOperator(edge_options[c]).Extract(findings.photographs[c].grey, seen.edges[c]);
    seen.views.push_back(MakeView(seen.cameras[c], seen.edges[c]));
  }
  seen.doors = DetectDoors(seen.views[0], seen.views[1], DoorOptions(options.max_door_width_m));
  return seen;
}

SeenLandmark FindLandmark(const SeeOptions& options, const std::vector<CameraView>& views) {
  const Polyhedron body = LoadPolyhedron(options.landmark);
  const Eigen::Isometry3d believed = PoseFromSix(options.at);
  return {body, believed, LocateFreeModel(body, believed, views, {})};
}

}  // namespace

std::vector<cv::Mat> SeeFindings::Greys() const {
  return GreysOf(photographs);
}

SeeFindings FindAll(const SeeOptions& options) {
  SeeFindings findings;
  findings.photographs = ReadPhotographs(options);
  findings.cameras = ReadCameras(options, findings.photographs);
  for (std::size_t i = 0; i < findings.cameras.size(); ++i)
    findings.views.push_back(MakeView(findings.cameras[i], findings.photographs[i].edges));
  if (findings.cameras.size() > 1) {
    RefuseSameImage(findings.photographs);
    findings.matches = MatchViews(findings);
  }
  if (!options.stand.empty()) findings.doors = FindDoors(options, findings);
  if (!options.landmark.empty()) findings.landmark = FindLandmark(options, findings.views);
  return findings;
}

int CountInSpace(std::span<const StereoMatch> matches) {
  return static_cast<int>(
      std::ranges::count_if(matches, [](const StereoMatch& m) { return m.space.has_value(); }));
}

}  // namespace priamos::head
