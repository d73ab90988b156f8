#include "head/locate/locate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "head/core/edges/equal_contrast.hpp"
#include "head/core/edges/photograph_edges.hpp"
#include "head/core/landmark/body_tracker.hpp"
#include "head/files/camera_file.hpp"
#include "head/files/image_file.hpp"
#include "head/files/landmark_file.hpp"
#include "head/locate/image_names.hpp"
#include "head/locate/moment_text.hpp"
#include "head/see/see_landmark.hpp"
#include "head/see/see_output.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 32;
constexpr std::string_view kNoFile = "-";

BodyTrackerOptions TrackerOptions(const LocateOptions& options) {
  BodyTrackerOptions tracker;
  tracker.fix.prior_share = options.prior_percent / 100;
  tracker.fix.prior_rad = Radians(options.prior_deg);
  tracker.fix.solver.model_sigma_m = options.model_sigma_m;
  tracker.motion_share = options.motion_percent / 100;
  tracker.motion_rad = Radians(options.motion_deg);
  return tracker;
}

/// The cameras, once the size of the images is known, and what they see in the images of a moment.
class Eyes {
 public:
  Eyes(const LocateOptions& options, std::size_t n) : options_(options), n_(n) {}

  /// Reads the images of one moment. Throws ConfigError naming one that cannot be used.
  void Read(const std::vector<std::string>& names) {
    greys_ = ReadImageFiles(names, kSmallest_px).grey;
    if (cameras_.empty()) cameras_ = Cameras(names);
    for (std::size_t i = 0; i < n_; ++i)
      if (greys_[i].size() != size_)
        throw ConfigError(fmt::format("{}: expected {}x{} pixels as the first image has, got {}x{}", names[i],
                                      size_.width, size_.height, greys_[i].cols, greys_[i].rows));
  }

  /// Finds the edges of the images read last.
  std::span<const CameraView> Look() {
    const auto contrast = ForOneScene(greys_, {});
    edges_.clear();
    for (std::size_t i = 0; i < n_; ++i) edges_.push_back(EdgesOfPhotograph(greys_[i], contrast[i]));
    views_.clear();
    for (std::size_t i = 0; i < n_; ++i) {
      views_.push_back(MakeView(cameras_[i], edges_[i].edges));
      views_.back().blur_px = edges_[i].MedianBlur();
    }
    return views_;
  }

  const cv::Mat& first() const { return greys_.front(); }
  std::span<const CameraView> views() const { return views_; }

 private:
  std::vector<CameraModel> Cameras(const std::vector<std::string>& names) {
    size_ = greys_.front().size();
    auto cameras = LoadCameras(options_.cameras, n_, {{size_.width, size_.height}, options_.are_rectified});
    if (cameras.size() != n_)
      throw ConfigError(fmt::format("{}: expected {} cameras, one for each image of a moment, got {}",
                                    names.front(), n_, cameras.size()));
    return cameras;
  }

  const LocateOptions& options_;
  std::size_t n_;
  cv::Size size_{};
  std::vector<cv::Mat> greys_;
  std::vector<CameraModel> cameras_;
  std::vector<BlurredEdges> edges_;
  std::vector<CameraView> views_;
};

/// The file for poses, or the sink for them, or neither.
class PoseLines {
 public:
  PoseLines(const LocateOptions& options, const LocateSinks& sinks) : options_(options), sinks_(sinks) {
    if (options.json.empty() || options.json == kNoFile) return;
    RefuseToReplace(options.json, Inputs(), options.force);
    file_.open(options.json);
    if (!file_)
      throw std::runtime_error(fmt::format("{}: cannot be written; name another place", options.json));
  }

  void Write(const nlohmann::ordered_json& pose) {
    if (options_.json == kNoFile) return sinks_.json(pose.dump() + "\n");
    if (!file_.is_open()) return;
    file_ << pose.dump() << std::endl;  // whoever follows the file sees the pose at once
    if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written any more", options_.json));
  }

 private:
  std::vector<std::string> Inputs() const {
    std::vector<std::string> inputs = options_.images;
    inputs.insert(inputs.end(), options_.cameras.begin(), options_.cameras.end());
    inputs.push_back(options_.model);
    return inputs;
  }

  const LocateOptions& options_;
  const LocateSinks& sinks_;
  std::ofstream file_;
};

/// One run through all images.
class Run {
 public:
  Run(const LocateOptions& options, const LocateSinks& sinks, std::size_t n_at_once)
      : options_(options),
        sinks_(sinks),
        body_(LoadPolyhedron(options.model, options.scale)),
        tracker_(body_, PoseFromSix(options.at), TrackerOptions(options)),
        eyes_(options, n_at_once),
        poses_(options, sinks) {
    if (!options.draw.empty() && !std::filesystem::is_directory(options.draw))
      throw std::runtime_error(
          fmt::format("--draw {}: expected a folder that exists, got none", options.draw));
  }

  void Moment(const std::vector<std::string>& names) {
    const auto begin = std::chrono::steady_clock::now();
    MomentReport report{names, {}, {}, 0, 0};
    try {
      eyes_.Read(names);
    } catch (const ConfigError& error) {
      if (tally_.n_moments == 0) throw;
      report.why_unread = error.what();
    }
    report.fix = tracker_.Look(report.why_unread.empty() ? eyes_.Look() : std::span<const CameraView>());
    report.time_ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    report.n_lost = tracker_.n_lost();
    Write(report);
    ++tally_.n_moments;
    tally_.n_found += report.fix.verdict == Verdict::kFound;
  }

  const LocateTally& tally() const { return tally_; }

 private:
  void Write(const MomentReport& report) {
    sinks_.text(MomentText(report));
    poses_.Write(MomentToJson(report, eyes_.views()));
    if (options_.draw.empty() || !report.why_unread.empty()) return;
    const std::string stem = std::filesystem::path(report.images.front()).stem();
    const std::string file = std::filesystem::path(options_.draw) / (stem + "-body.png");
    RefuseToReplace(file, report.images, options_.force);
    WriteWhole(file,
               DrawLandmark(eyes_.first(), eyes_.views(), body_, tracker_.believed(), report.fix).ToPng());
  }

  const LocateOptions& options_;
  const LocateSinks& sinks_;
  Polyhedron body_;
  BodyTracker tracker_;
  Eyes eyes_;
  PoseLines poses_;
  LocateTally tally_;
};

}  // namespace

LocateTally Locate(const LocateOptions& options, std::istream& lines, const LocateSinks& sinks) {
  const std::size_t n =
      options.n_at_once > 0 ? static_cast<std::size_t>(options.n_at_once) : options.cameras.size();
  ImageNames names(options.images, lines);
  Run run(options, sinks, n);
  while (const auto moment = names.Next(n)) run.Moment(*moment);
  if (run.tally().n_moments == 0) throw ConfigError("expected images, got none");
  sinks.text(fmt::format("{}: found in {} of {} {}\n", options.model, run.tally().n_found,
                         run.tally().n_moments, n == 1 ? "images" : "moments"));
  return run.tally();
}

}  // namespace priamos::head
