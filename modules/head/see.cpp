#include "head/see.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include "head/core/edge_segments.hpp"
#include "head/landmark_file.hpp"
#include "head/projection_file.hpp"
#include "head/see_doors.hpp"
#include "head/see_drawing.hpp"
#include "head/see_json.hpp"
#include "head/see_landmark.hpp"

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

/// Where a drawing goes; the folder's name keeps left/50.jpg and right/50.jpg apart.
std::string DrawingFile(const SeeOptions& options, const std::string& image, const char* what) {
  const std::filesystem::path path(image);
  const std::string parent =
      path.has_parent_path() ? path.parent_path().filename().string() + "-" : std::string();
  return std::filesystem::path(options.folder) /
         fmt::format("{}{}-{}.png", parent, path.stem().string(), what);
}

void Write(const std::string& file, const cv::Mat& drawing) {
  if (!cv::imwrite(file, drawing)) throw std::runtime_error(fmt::format("{}: cannot be written", file));
}

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

nlohmann::ordered_json SeeEach(const SeeOptions& options, const std::vector<Photograph>& photographs) {
  auto all = nlohmann::ordered_json::array();
  for (const Photograph& p : photographs) {
    const ContourGraph contours(p.edges, {});
    const auto is_parallelogram = [](const Polygon& q) { return q.is_parallelogram; };
    const std::string drawing = DrawingFile(options, p.file, "edges");
    Write(drawing, DrawContours(p.grey, p.edges, contours));
    std::cout << fmt::format("{}: {} segments, {} corners, {} parallelograms, drawn in {}\n", p.file,
                             p.edges.segments.size(), contours.corners().size(),
                             std::ranges::count_if(contours.polygons(), is_parallelogram), drawing);
    all.push_back(EdgesToJson(p.file, p.edges, contours));
    if (const auto why = WhyBlind(p.edges); !why.empty()) {
      std::cout << fmt::format("{}: nothing can be seen: {}\n", p.file, why);
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

nlohmann::ordered_json SeeTogether(const SeeOptions& options, const std::vector<Photograph>& photographs,
                                   const std::vector<CameraModel>& cameras) {
  const std::vector<CameraView> views = Views(photographs, cameras);
  std::vector<cv::Mat> greys;
  for (const Photograph& p : photographs) greys.push_back(p.grey);
  const auto matches = Match(views);
  const auto reconstructed = InSpace(matches);
  RefuseExchanged(photographs, cameras, reconstructed);
  const std::string drawing = DrawingFile(options, photographs[0].file, "stereo");
  Write(drawing, DrawMatches(greys, views, matches));
  std::cout << fmt::format("together: {} matches, {} of them with a place in space, drawn in {}\n",
                           matches.size(), reconstructed, drawing);
  return MatchesToJson(views, matches);
}

nlohmann::ordered_json SeeLandmark(const SeeOptions& options, const std::vector<Photograph>& photographs,
                                   const std::vector<CameraModel>& cameras, bool& found) {
  const Polyhedron body = LoadPolyhedron(options.landmark);
  const Eigen::Isometry3d believed = PoseFromSix(options.at);
  const std::vector<CameraView> views = Views(photographs, cameras);
  const FreeModelFix fix = LocateFreeModel(body, believed, views, {});
  const std::string drawing = DrawingFile(options, photographs[0].file, "landmark");
  Write(drawing, DrawLandmark(photographs[0].grey, views, body, believed, fix));
  found = fix.verdict == Verdict::kFound;
  if (found) {
    const auto at = SixFromPose(fix.base_from_model);
    std::cout << fmt::format(
        "{}: at {:.4f} {:.4f} {:.4f} m, {:.3f} {:.3f} {:.3f} deg; {} edges, {:.2f} px, drawn in {}\n",
        options.landmark, at[0], at[1], at[2], at[3], at[4], at[5], fix.n_matched, fix.residual_px, drawing);
  } else {
    std::cout << fmt::format("{}: not found: {}; drawn in {}\n", options.landmark, Describe(fix.verdict),
                             drawing);
  }
  return LandmarkToJson(views, fix);
}

nlohmann::ordered_json SeeDoors(const SeeOptions& options, const std::vector<Photograph>& photographs,
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
  const std::string drawing = DrawingFile(options, photographs[0].file, "doors");
  Write(drawing, DrawDoors(greys, views, doors));
  std::cout << fmt::format("doors: {}, drawn in {}\n", doors.size(), drawing);
  for (const DetectedDoor& door : doors)
    std::cout << fmt::format(
        "  {:.2f} m ahead, {:.2f} m to the left, {:.1f} deg; {:.2f} m wide, {:.2f} m high, "
        "sigma {:.2f} m\n",
        door.base_from_door.x, door.base_from_door.y, Degrees(door.base_from_door.yaw), door.width_m,
        door.height_m, std::sqrt(door.covariance.trace()));
  return DoorsToJson(doors);
}

}  // namespace

bool See(const SeeOptions& options) {
  if (!options.landmark.empty() && options.cameras.empty())
    throw std::runtime_error(
        fmt::format("{}: expected a camera for each image to look for it", options.landmark));
  const auto photographs = Read(options);
  const auto cameras = Cameras(options, photographs);
  bool found = true;
  nlohmann::ordered_json all{{"images", SeeEach(options, photographs)}};
  if (cameras.size() > 1) all["matches"] = SeeTogether(options, photographs, cameras);
  if (!options.stand.empty()) all["doors"] = SeeDoors(options, photographs, cameras);
  if (!options.landmark.empty()) all["landmark"] = SeeLandmark(options, photographs, cameras, found);
  if (options.json.empty()) return found;
  std::ofstream out(options.json);
  out << all.dump(1) << "\n";
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", options.json));
  return found;
}

}  // namespace priamos::head
