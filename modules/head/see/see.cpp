#include "head/see/see.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include "head/core/edges/edge_segments.hpp"
#include "head/files/landmark_file.hpp"
#include "head/files/projection_file.hpp"
#include "head/see/see_doors.hpp"
#include "head/see/see_drawing.hpp"
#include "head/see/see_json.hpp"
#include "head/see/see_landmark.hpp"
#include "head/see/see_output.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 32;
constexpr double kFarthestDoor_m = 12;  // nobody drives by these: far ones may be uncertain

cv::Mat ReadGrey(const std::string& file) {
  const cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
  if (image.empty())
    throw std::runtime_error(fmt::format("{}: expected an image (PNG, JPEG, PGM ...), got none", file));
  if (image.cols < kSmallest_px || image.rows < kSmallest_px)
    throw std::runtime_error(fmt::format("{}: expected at least {}x{} pixels, got {}x{}", file, kSmallest_px,
                                         kSmallest_px, image.cols, image.rows));
  return image;
}

/// All that `options` ask for.
std::vector<PlannedDrawing> Plan(const SeeOptions& options) {
  std::vector<PlannedDrawing> drawings;
  for (const std::string& image : options.images) drawings.push_back({image, "edges"});
  if (options.cameras.size() > 1) drawings.push_back({options.images.front(), "stereo"});
  if (!options.stand.empty()) drawings.push_back({options.images.front(), "doors"});
  if (!options.landmark.empty()) drawings.push_back({options.images.front(), "landmark"});
  return drawings;
}

SeeOutput OutputOf(const SeeOptions& options) {
  std::vector<std::string> inputs = options.images;
  inputs.insert(inputs.end(), options.cameras.begin(), options.cameras.end());
  if (!options.landmark.empty()) inputs.push_back(options.landmark);
  if (!options.json.empty()) RefuseToReplace(options.json, inputs, options.force);
  return {Plan(options), inputs, options.output, options.force};
}

/// What was found, in pictures and words: shown when all of it is there.
struct Findings {
  SeeOutput output;
  std::string text{};
};

struct Photograph {
  std::string file;
  cv::Mat grey;
  EdgeImage edges;
};

std::vector<Photograph> Read(const SeeOptions& options) {
  std::vector<Photograph> photographs;
  EdgeOperator edge_operator;
  for (const std::string& file : options.images) {
    Photograph& p = photographs.emplace_back(file, ReadGrey(file));
    edge_operator.Extract(p.grey, p.edges);
  }
  return photographs;
}

std::vector<CameraModel> Cameras(const SeeOptions& options, const std::vector<Photograph>& photographs) {
  if (options.cameras.empty()) return {};
  const std::size_t n = photographs.size();
  const std::size_t fewest = options.landmark.empty() ? 2 : 1;
  if (options.cameras.size() != n || n < fewest || n > 3)
    throw std::runtime_error(fmt::format("expected {} images and a camera for each, got {} and {}",
                                         fewest == 1 ? "one to three" : "two or three", n,
                                         options.cameras.size()));
  std::vector<CameraModel> cameras;
  for (std::size_t i = 0; i < n; ++i) {
    if (photographs[i].grey.size() != photographs[0].grey.size())
      throw std::runtime_error(fmt::format("{}: expected the size of {}, got {}x{}", photographs[i].file,
                                           photographs[0].file, photographs[i].grey.cols,
                                           photographs[i].grey.rows));
    cameras.push_back(LoadProjection(options.cameras[i], photographs[i].grey.cols, photographs[i].grey.rows));
  }
  return cameras;
}

nlohmann::ordered_json SeeEach(Findings& findings, const std::vector<Photograph>& photographs) {
  auto all = nlohmann::ordered_json::array();
  for (const Photograph& p : photographs) {
    const ContourGraph contours(p.edges, {});
    const auto is_parallelogram = [](const Polygon& q) { return q.is_parallelogram; };
    const std::string drawing =
        findings.output.Add(p.file, "edges", DrawContours(p.grey, p.edges, contours).ToPng());
    findings.text += fmt::format("{}: {} segments, {} corners, {} parallelograms, drawn in {}\n", p.file,
                                 p.edges.segments.size(), contours.corners().size(),
                                 std::ranges::count_if(contours.polygons(), is_parallelogram), drawing);
    all.push_back(EdgesToJson(p.file, p.edges, contours));
    if (const auto why = WhyBlind(p.edges); !why.empty()) {
      findings.text += fmt::format("{}: nothing can be seen: {}\n", p.file, why);
      all.back()["unusable"] = why;
    }
  }
  return all;
}

std::vector<CameraView> Views(const std::vector<Photograph>& photographs,
                              const std::vector<CameraModel>& cameras) {
  std::vector<CameraView> views;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    views.push_back(MakeView(cameras[i], photographs[i].edges));
  return views;
}

std::vector<StereoMatch> Match(const std::vector<CameraView>& views) {
  return views.size() == 2 ? MatchBinocular(views[0], views[1], {})
                           : MatchTrinocular(views[0], views[1], views[2], {});
}

std::ptrdiff_t InSpace(const std::vector<StereoMatch>& matches) {
  return std::ranges::count_if(matches, [](const StereoMatch& m) { return m.space.has_value(); });
}

/// Seen from the wrong side everything lies behind the cameras, or nothing fits.
void RefuseExchanged(const std::vector<Photograph>& photographs, const std::vector<CameraModel>& cameras,
                     std::ptrdiff_t n_as_given) {
  const auto exchanged = InSpace(MatchBinocular(MakeView(cameras[0], photographs[1].edges),
                                                MakeView(cameras[1], photographs[0].edges), {}));
  if (exchanged >= 2 && exchanged > 3 * n_as_given)
    throw std::runtime_error(fmt::format(
        "{} and {}: expected the images in the order of their cameras: {} edges fit as they are, {} "
        "if the images are exchanged",
        photographs[0].file, photographs[1].file, n_as_given, exchanged));
}

nlohmann::ordered_json SeeTogether(Findings& findings, const std::vector<Photograph>& photographs,
                                   const std::vector<CameraModel>& cameras) {
  const std::vector<CameraView> views = Views(photographs, cameras);
  std::vector<cv::Mat> greys;
  for (const Photograph& p : photographs) greys.push_back(p.grey);
  const auto matches = Match(views);
  const auto reconstructed = InSpace(matches);
  RefuseExchanged(photographs, cameras, reconstructed);
  const std::string drawing =
      findings.output.Add(photographs[0].file, "stereo", DrawMatches(greys, views, matches).ToPng());
  findings.text += fmt::format("together: {} matches, {} of them with a place in space, drawn in {}\n",
                               matches.size(), reconstructed, drawing);
  return MatchesToJson(views, matches);
}

nlohmann::ordered_json SeeLandmark(const SeeOptions& options, Findings& findings,
                                   const std::vector<Photograph>& photographs,
                                   const std::vector<CameraModel>& cameras, bool& found) {
  const Polyhedron body = LoadPolyhedron(options.landmark);
  const Eigen::Isometry3d believed = PoseFromSix(options.at);
  const std::vector<CameraView> views = Views(photographs, cameras);
  const FreeModelFix fix = LocateFreeModel(body, believed, views, {});
  const std::string drawing = findings.output.Add(
      photographs[0].file, "landmark", DrawLandmark(photographs[0].grey, views, body, believed, fix).ToPng());
  found = fix.verdict == Verdict::kFound;
  if (found) {
    const auto at = SixFromPose(fix.base_from_model);
    findings.text += fmt::format(
        "{}: at {:.4f} {:.4f} {:.4f} m, {:.3f} {:.3f} {:.3f} deg; {} edges, {:.2f} px, drawn in {}\n",
        options.landmark, at[0], at[1], at[2], at[3], at[4], at[5], fix.n_matched, fix.residual_px, drawing);
  } else {
    findings.text +=
        fmt::format("{}: not found: {}; drawn in {}\n", options.landmark, Describe(fix.verdict), drawing);
  }
  return LandmarkToJson(views, fix);
}

nlohmann::ordered_json SeeDoors(const SeeOptions& options, Findings& findings,
                                const std::vector<Photograph>& photographs,
                                const std::vector<CameraModel>& cameras) {
  if (cameras.size() != 2)
    throw std::runtime_error(
        fmt::format("expected two images and their cameras to look for doors, got {}", cameras.size()));
  const auto standing = OnTheFloor(cameras, options.stand);
  EdgeOperator edge_operator(DoorEdges());
  std::array<EdgeImage, 2> edges;
  for (int c = 0; c < 2; ++c) edge_operator.Extract(photographs[c].grey, edges[c]);
  const std::vector<CameraView> views{MakeView(standing[0], edges[0]), MakeView(standing[1], edges[1])};
  DoorDetectionOptions detection;
  detection.stereo.max_range_m = kFarthestDoor_m;
  if (options.max_door_width_m > detection.max_width_m) {  // one leaf or two
    detection.width_sigma_m += (options.max_door_width_m - detection.max_width_m) / 2;
    detection.usual_width_m += (options.max_door_width_m - detection.max_width_m) / 2;
  }
  detection.max_width_m = options.max_door_width_m;
  const auto doors = DetectDoors(views[0], views[1], detection);
  const std::vector<cv::Mat> greys{photographs[0].grey, photographs[1].grey};
  const std::string drawing =
      findings.output.Add(photographs[0].file, "doors", DrawDoors(greys, views, doors).ToPng());
  findings.text += fmt::format("doors: {}, drawn in {}\n", doors.size(), drawing);
  int number = 0;
  for (const DetectedDoor& door : doors)
    findings.text += fmt::format(
        "  door {}: {:.2f} m ahead, {:.2f} m to the left, {:.1f} deg; {:.2f} m wide, {:.2f} m high, "
        "sigma {:.2f} m\n",
        ++number, door.base_from_door.x, door.base_from_door.y, Degrees(door.base_from_door.yaw),
        door.width_m, door.height_m, std::sqrt(door.covariance.trace()));
  return DoorsToJson(doors);
}

}  // namespace

bool See(const SeeOptions& options) {
  if (!options.landmark.empty() && options.cameras.empty())
    throw std::runtime_error(
        fmt::format("{}: expected a camera for each image to look for it", options.landmark));
  Findings findings{OutputOf(options)};
  const auto photographs = Read(options);
  const auto cameras = Cameras(options, photographs);
  bool found = true;
  nlohmann::ordered_json all{{"images", SeeEach(findings, photographs)}};
  if (cameras.size() > 1) all["matches"] = SeeTogether(findings, photographs, cameras);
  if (!options.stand.empty()) all["doors"] = SeeDoors(options, findings, photographs, cameras);
  if (!options.landmark.empty())
    all["landmark"] = SeeLandmark(options, findings, photographs, cameras, found);
  findings.output.Write();
  if (!options.json.empty()) WriteWhole(options.json, all.dump(1) + "\n");
  std::cout << findings.text;
  return found;
}

}  // namespace priamos::head
