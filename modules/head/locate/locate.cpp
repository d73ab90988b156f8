#include "head/locate/locate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "head/core/bodies/body_tracker.hpp"
#include "head/files/landmark_file.hpp"
#include "head/locate/body_drawings.hpp"
#include "head/locate/eyes.hpp"
#include "head/locate/image_names.hpp"
#include "head/locate/moment_text.hpp"
#include "head/see/see_landmark.hpp"
#include "head/see/see_output.hpp"

namespace priamos::head {
namespace {

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

/// The file for poses, or the sink for them, or neither.
class PoseLines {
 public:
  PoseLines(const LocateOptions& options, const LocateSinks& sinks, const std::vector<std::string>& inputs)
      : options_(options), sinks_(sinks) {
    if (options.json.empty() || options.json == kNoFile) return;
    RefuseToReplace(options.json, inputs, options.force);
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
  const LocateOptions& options_;
  const LocateSinks& sinks_;
  std::ofstream file_;
};

/// One run through all images.
class Run {
 public:
  Run(const LocateOptions& options, const LocateSinks& sinks, std::size_t n_at_once)
      : sinks_(sinks),
        model_(LoadBody(options.model, options.scale)),
        tracker_(model_.body, PoseFromSix(options.at), TrackerOptions(options)),
        eyes_(options.cameras, options.are_rectified, n_at_once),
        inputs_(Inputs(options, model_.files)),
        poses_(options, sinks, inputs_),
        drawings_(options.draw, options.force) {}

  void Moment(const std::vector<std::string>& names) {
    const auto begin = std::chrono::steady_clock::now();
    inputs_.insert(inputs_.end(), names.begin(), names.end());
    MomentReport report{names, {}, {}, 0, 0};
    if (const auto refusal = ReadUntouched(names)) report.why_unread = refusal->reason;
    report.fix = tracker_.Look(report.why_unread.empty() ? eyes_.Look() : std::span<const CameraView>());
    report.time_ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    report.n_lost = tracker_.n_lost();
    Write(report);
    if (tally_.n_moments == 0) first_refusal_ = report.why_unread;
    ++tally_.n_moments;
    tally_.n_found += report.fix.verdict == Verdict::kFound;
  }

  /// Throws ConfigError when there was not one image.
  LocateTally Finish() const {
    if (tally_.n_moments == 0) throw ConfigError("expected images, got none");
    if (!eyes_.has_seen()) throw ConfigError(first_refusal_);
    return tally_;
  }

 private:
  /// What must never be replaced.
  static std::vector<std::string> Inputs(const LocateOptions& options,
                                         const std::vector<std::string>& model) {
    std::vector<std::string> inputs = options.images;
    inputs.insert(inputs.end(), options.cameras.begin(), options.cameras.end());
    inputs.insert(inputs.end(), model.begin(), model.end());
    return inputs;
  }

  std::optional<Refusal> ReadUntouched(const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (drawings_.HasDrawn(name))
        return Refusal{fmt::format("{}: expected an image, got a drawing of this run", name)};
    return eyes_.Read(names);
  }

  void Write(const MomentReport& report) {
    sinks_.text(MomentText(report));
    poses_.Write(MomentToJson(report, eyes_.views()));
    if (!drawings_.wanted() || !report.why_unread.empty()) return;
    const SeePage page =
        DrawLandmark(eyes_.first(), eyes_.views(), model_.body, tracker_.believed(), report.fix);
    drawings_.Write(report.images.front(), inputs_, page.ToPng());
  }

  const LocateSinks& sinks_;
  BodyFile model_;
  BodyTracker tracker_;
  Eyes eyes_;
  std::vector<std::string> inputs_;
  PoseLines poses_;
  BodyDrawings drawings_;
  std::string first_refusal_;  ///< of the first moment; empty if it was read
  LocateTally tally_;
};

}  // namespace

LocateTally Locate(const LocateOptions& options, std::istream& lines, const LocateSinks& sinks) {
  const std::size_t n =
      options.n_at_once > 0 ? static_cast<std::size_t>(options.n_at_once) : options.cameras.size();
  ImageNames names(options.images, lines);
  Run run(options, sinks, n);
  while (const auto moment = names.Next(n)) run.Moment(*moment);
  const LocateTally tally = run.Finish();
  sinks.text(fmt::format("{}: found in {} of {} {}\n", options.model, tally.n_found, tally.n_moments,
                         n == 1 ? "images" : "moments"));
  return tally;
}

}  // namespace priamos::head
