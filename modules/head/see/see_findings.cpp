#include "head/see/see_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "head/core/edges/equal_contrast.hpp"
#include "head/core/edges/photograph_edges.hpp"
#include "head/core/stereo/pair_order.hpp"
#include "head/files/camera_file.hpp"
#include "head/files/image_file.hpp"
#include "head/files/landmark_file.hpp"
#include "head/see/see_landmark.hpp"
#include "head/see/separate_views.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 32;

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
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    BlurredEdges found = EdgesOfPhotograph(photographs[i].grey, options[i]);
    photographs[i].blur_px = found.MedianBlur();
    photographs[i].edges = std::move(found.edges);
  }
  for (SeenPhotograph& photograph : photographs) photograph.contours = {photograph.edges, {}};
}

void ReadPhotographs(const SeeOptions& options, SeeFindings& findings) {
  ImageFiles files = ReadImageFiles(options.images, kSmallest_px);
  findings.note = std::move(files.note);
  for (std::size_t i = 0; i < options.images.size(); ++i) {
    SeenPhotograph& photograph = findings.photographs.emplace_back();
    photograph.file = options.images[i];
    photograph.grey = files.grey[i];
  }
  FindEdges(!options.cameras.empty(), findings.photographs);
}

std::vector<CameraModel> ReadCameras(const SeeOptions& options,
                                     const std::vector<SeenPhotograph>& photographs) {
  if (options.cameras.empty()) return {};
  const std::size_t n = photographs.size();
  const std::size_t fewest = options.landmark.empty() && !WantsDoors(options) ? 2 : 1;
  const auto check_number = [&](std::size_t n_cameras) {
    if (n_cameras != n || n < fewest || n > 3)
      throw std::runtime_error(fmt::format("expected {} images and a camera for each, got {} and {}",
                                           fewest == 1 ? "one to three" : "two or three", n, n_cameras));
  };
  if (options.cameras.size() != 1) check_number(options.cameras.size());
  const cv::Size size = photographs[0].grey.size();
  for (const SeenPhotograph& photograph : photographs)
    if (photograph.grey.size() != size)
      throw std::runtime_error(fmt::format("{}: expected the size of {}, got {}x{}", photograph.file,
                                           photographs[0].file, photograph.grey.cols, photograph.grey.rows));
  auto cameras = LoadCameras(options.cameras, n, {{size.width, size.height}, options.are_rectified});
  check_number(cameras.size());
  RefuseOnePlace(options.cameras, cameras);
  return cameras;
}

/// Why a pair cannot be used, without the names of its files; empty if it can be, or shows nothing at all.
std::string WhyNoPair(const PairOrder& order, const CameraView& first, const CameraView& second) {
  switch (order.verdict) {
    case PairVerdict::kRight:
      return "";
    case PairVerdict::kUnknown:
      if (first.lines.empty() || second.lines.empty()) return "";
      return fmt::format("expected images of one scene, got {} and {} edges, none of which is in both",
                         first.lines.size(), second.lines.size());
    case PairVerdict::kSameView:
      return fmt::format(
          "expected an image of each camera, got nearly the same image twice: {} of {} edges that should "
          "have "
          "moved stand still",
          order.n_still, order.n_should_move);
    case PairVerdict::kExchanged:
      break;
  }
  return fmt::format(
      "expected the images in the order of their cameras: {} edges fit as they are, {} if the images are "
      "exchanged",
      order.n_as_given, order.n_exchanged);
}

/// Seen from the wrong side everything lies behind the cameras; seen twice nothing moves.
void RefuseWrongOrder(const SeeFindings& findings) {
  const auto& views = findings.views;
  for (std::size_t j = 1; j < views.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const auto why = WhyNoPair(JudgeOrder(views[i], views[j], StereoOptions()), views[i], views[j]);
      if (!why.empty())
        throw std::runtime_error(
            fmt::format("{} and {}: {}", findings.photographs[i].file, findings.photographs[j].file, why));
    }
}

std::vector<StereoMatch> MatchViews(const SeeFindings& findings) {
  const auto& views = findings.views;
  RefuseWrongOrder(findings);
  return views.size() == 2 ? MatchBinocular(views[0], views[1], {})
                           : MatchTrinocular(views[0], views[1], views[2], {});
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
  ReadPhotographs(options, findings);
  findings.cameras = ReadCameras(options, findings.photographs);
  for (std::size_t i = 0; i < findings.cameras.size(); ++i) {
    findings.views.push_back(MakeView(findings.cameras[i], findings.photographs[i].edges));
    findings.views.back().blur_px = findings.photographs[i].blur_px;
    findings.views.back().image = &findings.photographs[i].grey;
  }
  if (findings.cameras.size() > 1) {
    RefuseSameImage(options.images, findings.Greys());
    findings.matches = MatchViews(findings);
  }
  if (WantsDoors(options)) findings.doors = FindDoors(options, findings.Greys(), findings.cameras);
  if (!options.landmark.empty()) findings.landmark = FindLandmark(options, findings.views);
  return findings;
}

int CountInSpace(std::span<const StereoMatch> matches) {
  return static_cast<int>(
      std::ranges::count_if(matches, [](const StereoMatch& m) { return m.space.has_value(); }));
}

}  // namespace priamos::head
