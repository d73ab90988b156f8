#include "head/calibration_mode.hpp"

#include <fmt/format.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "head/calibration_report.hpp"
#include "head/core/calibration/discs/disc_detection.hpp"
#include "head/core/calibration/rig/progress_bar.hpp"
#include "head/core/calibration/targets/camera_calibration.hpp"
#include "head/files/calibration_file.hpp"
#include "head/head_messages.hpp"

namespace priamos::head {
namespace {

Eigen::Isometry3d BaseFromObject(const ReferencePose& pose) {
  Eigen::Isometry3d base_from_object = Eigen::Isometry3d::Identity();
  base_from_object.translate(Eigen::Vector3d(pose.x_m, pose.y_m, pose.z_m));
  base_from_object.rotate(Eigen::AngleAxisd(Radians(pose.yaw_deg), Eigen::Vector3d::UnitZ()));
  return base_from_object;
}

/// What must be the same for old measurements to be of use.
std::string FingerprintOf(const HeadConfig& config, const ReferenceObject& object) {
  std::ostringstream text;
  PrintConfig(text, object);
  PrintConfig(text, config.reference);
  PrintConfig(text, config.plan);
  return Fingerprint(text.str());
}

bool HadLaser(const std::string& table) {
  try {
    return !LoadHeadModel(table).lasers.empty();
  } catch (const ConfigError&) {
    return false;  // there was none, or none that could be read
  }
}

}  // namespace

CalibrationMode::CalibrationMode(const HeadConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      table_path_(context.ResolvePath(config.calibration)),
      object_(LoadConfig<ReferenceObject>(context.ResolvePath(config.reference.object))),
      object_in_base_(object_.Moved(BaseFromObject(config.reference))),
      labeller_(object_),
      settings_(config.plan.Settings()),
      journal_(table_path_ + ".journal", FingerprintOf(config, object_),
               static_cast<int>(object_.discs.size())),
      done_(journal_.Resume()),
      resumed_(done_.size()),
      positioner_(config.motors),
      look_(config.look, kCameras),
      cameras_(context.instance() + "-camera"),
      head_state_(context.node().Subscribe(channels::kHeadState)),
      frames_(context.node().SubscribeAll(channels::kCameraFrame)),
      head_command_(context.node().Advertise(channels::kHeadCommand)),
      trigger_(context.node().Advertise(channels::kCameraTrigger)) {
  context_.Log(
      bus::Level::kInfo,
      fmt::format("takes pictures of the reference object at {} settings; the table goes to {}, until "
                  "then {} keeps what is finished, and the same command goes on there",
                  settings_.size(), table_path_, table_path_ + ".journal"));
  if (resumed_ > 0)
    context_.Log(bus::Level::kInfo,
                 fmt::format("goes on after {} of {} settings", resumed_, settings_.size()));
}

void CalibrationMode::Tick(Time now) {
  if (context_.exit_code()) return;
  if (!begun_) begun_ = now;
  TakeMessages();
  if (!look_.active()) {
    if (done_.size() >= settings_.size()) return Finish();
    positioner_.MoveTo(settings_[done_.size()], now);
    look_.Begin(now);
  }
  if (const auto setting = positioner_.Step(report_ ? &*report_ : nullptr, now))
    head_command_.Publish(ToMessage(*setting, now));
  Look(now);
}

void CalibrationMode::TakeMessages() {
  if (const auto state = head_state_.Take()) report_ = FromMessage(*state);
  for (const camera_frame_t& message : frames_.Drain()) look_.Add(FromMessage(message));
}

void CalibrationMode::Look(Time now) {
  switch (look_.Step(positioner_.settled(), positioner_.failed(), now)) {
    case LookSequence::Action::kWait:
      return;
    case LookSequence::Action::kTrigger:
      return trigger_.Publish(TriggerMessage(look_.frame_id(), look_.camera_mask(), now));
    case LookSequence::Action::kGiveUp:
      return Fail(positioner_.failed() ? "the head did not reach its setting"
                                       : "no pictures arrived from the cameras");
    case LookSequence::Action::kUseFrames:
      Use(look_.frames(), now);
      look_.End();
  }
}

void CalibrationMode::Use(const Frames& frames, Time now) {
  CalibrationExposure exposure{report_->setting, {}};
  const HeadSetting& s = exposure.setting;
  std::string note;
  for (const FrameNotice& frame : frames) exposure.cameras.push_back(Recognise(frame, note));
  journal_.Add(exposure);
  done_.push_back(exposure);
  const int new_ones = static_cast<int>(done_.size() - resumed_),
            all = static_cast<int>(settings_.size() - resumed_);
  context_.Log(bus::Level::kInfo,
               fmt::format("{}; {} of {}, pan {:+.1f}, tilt {:+.1f} deg, zoom {}, focus {}:{}",
                           ProgressBar(new_ones, all, Seconds(now - *begun_)), done_.size(), settings_.size(),
                           Degrees(s.pan_rad), Degrees(s.tilt_rad), s.zoom_step[0], s.focus_step[0], note));
}

/// The discs in one picture; none, with the reason in `note`, if the object is not recognised.
std::vector<SeenDisc> CalibrationMode::Recognise(const FrameNotice& frame, std::string& note) {
  note += fmt::format(" {}", kCameraNames[frame.camera]);
  const auto image = cameras_.Read(frame);
  if (!image) {
    note += " no picture";
    return std::vector<SeenDisc>();
  }
  const std::vector<DetectedDisc> detections = DetectDiscs(*image);
  const Outcome<Labelling> labelling = labeller_.Label(detections);
  if (!labelling) {
    note += fmt::format(" none ({})", labelling.reason());
    return std::vector<SeenDisc>();
  }
  std::vector<SeenDisc> discs;
  for (const auto& [disc, detection] : labelling->labels) {
    const DetectedDisc& d = detections[detection];
    discs.push_back({disc, d.ellipse.centre_px.x(), d.ellipse.centre_px.y(), std::max(d.sigma_px, 1e-3)});
  }
  note += fmt::format(" {}", discs.size());
  return discs;
}

std::vector<HeadView> CalibrationMode::Views() const {
  std::vector<HeadView> views;
  for (std::size_t k = 0; k < done_.size(); ++k) {
    for (std::size_t c = 0; c < done_[k].cameras.size(); ++c) {
      if (done_[k].cameras[c].empty()) continue;
      // The counters belong to the setting that was asked for: a node of the grid, not a step beside it.
      HeadView view{settings_[k], static_cast<int>(k), static_cast<int>(c), {}};
      for (const SeenDisc& d : done_[k].cameras[c])
        view.discs.push_back({object_in_base_.discs[d.disc], {d.u_px, d.v_px}, d.sigma_px});
      views.push_back(std::move(view));
    }
  }
  return views;
}

void CalibrationMode::Finish() {
  HeadKnowledge known;
  known.drawing = config_.drawing;
  const std::vector<HeadView> views = Views();
  auto result = SolveHead(views, known);
  if (!result) return Fail(result.reason());
  const ReferencePose& stand = config_.reference;
  result->model.base_covariance =
      PlacementCovariance({stand.x_m, stand.y_m, stand.z_m}, stand.error_m, Radians(stand.error_deg));
  // The report first: without the table the journal is still there, and the calibration can be repeated.
  const std::string report = table_path_ + "-report";
  const ReportedErrors errors{ReconstructObject(views, result->model), PredictHeldOut(views, known)};
  WriteCalibrationReport(report, views, *result, errors, config_.LookSetting());
  const bool had_laser = HadLaser(table_path_);
  SaveHeadModel(table_path_, result->model);
  journal_.Remove();
  if (had_laser)
    context_.Log(bus::Level::kWarning,
                 "the planes of the lasers belonged to the old table: calibrate them anew (priamos calibrate "
                 "--laser)");
  for (int camera = 0; camera < kCameras; ++camera)
    context_.Log(bus::Level::kInfo,
                 fmt::format("{} camera at pan 0, tilt {:.1f} deg, zoom {}, focus {}:\n{}",
                             kCameraNames[camera], config_.tilt_deg, config_.zoom_step, config_.focus_step,
                             PhysicalParameters(result->model, config_.LookSetting(), camera)));
  context_.Log(bus::Level::kInfo,
               fmt::format("{} settings calibrated, F {:.3f} px; {}; written to {}; report: {}/index.html",
                           done_.size(), result->mean_error_px, errors.ToText(), table_path_, report));
  context_.RequestStop(0);
}

void CalibrationMode::Fail(const std::string& reason) {
  context_.Log(bus::Level::kError, "not calibrated: " + reason);
  context_.RequestStop(1);
}

}  // namespace priamos::head
