#include "head/calibration_mode.hpp"

#include <fmt/format.h>

#include "head/calibration_file.hpp"
#include "head/core/calibration/camera_calibration.hpp"
#include "head/head_messages.hpp"

namespace priamos::head {
namespace {

constexpr const char* kCameraNames[] = {"left", "right"};

Eigen::Isometry3d BaseFromObject(const ReferencePose& pose) {
  Eigen::Isometry3d base_from_object = Eigen::Isometry3d::Identity();
  base_from_object.translate(Eigen::Vector3d(pose.x_m, pose.y_m, pose.z_m));
  base_from_object.rotate(Eigen::AngleAxisd(Radians(pose.yaw_deg), Eigen::Vector3d::UnitZ()));
  return base_from_object;
}

}  // namespace

CalibrationMode::CalibrationMode(const HeadConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      object_(LoadConfig<ReferenceObject>(context.ResolvePath(config.reference.object))),
      labeller_(object_),
      base_from_object_(BaseFromObject(config.reference)),
      settings_(config.Settings()),
      table_size_(settings_.size()),
      positioner_(config.motors),
      look_(config.look),
      cameras_(context.instance() + "-camera"),
      head_state_(context.node().Subscribe(channels::kHeadState)),
      frames_(context.node().SubscribeAll(channels::kCameraFrame)),
      head_command_(context.node().Advertise(channels::kHeadCommand)),
      trigger_(context.node().Advertise(channels::kCameraTrigger)) {
  const auto sweep = config.SweepSettings();
  settings_.insert(settings_.end(), sweep.begin(), sweep.end());
}

void CalibrationMode::Tick(Time now) {
  if (context_.exit_code()) return;
  TakeMessages();
  if (!look_.active()) {
    if (done_.size() == settings_.size()) return Finish();
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
      return trigger_.Publish(TriggerMessage(look_.frame_id(), now));
    case LookSequence::Action::kGiveUp:
      return Fail(positioner_.failed() ? "the head did not reach its setting"
                                       : "no stereo pair arrived from the cameras");
    case LookSequence::Action::kUsePair:
      Calibrate(look_.pair());
      look_.End();
  }
}

void CalibrationMode::Calibrate(const FramePair& pair) {
  View view{settings_[done_.size()], {}};
  std::string line =
      fmt::format("setting {} of {}, pan {:+.1f}, tilt {:+.1f} degrees:", done_.size() + 1, settings_.size(),
                  Degrees(view.setting.pan_rad), Degrees(view.setting.tilt_rad));
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const auto image = cameras_.Read(pair[i]);
    if (!image) return Fail("a picture was not in the frame store");
    const auto camera = CalibrateCamera(*image, object_, labeller_, base_from_object_);
    if (camera) {
      view.cameras[i] = *camera;
      line +=
          fmt::format(" {} {} discs, F {:.3f} px;", kCameraNames[i], camera->discs, camera->mean_error_px);
    } else if (done_.size() < table_size_) {
      return Fail(fmt::format("{} camera, pan {:.1f} degrees: {}", kCameraNames[i],
                              Degrees(view.setting.pan_rad), camera.reason()));
    } else {
      line += fmt::format(" {} left out;", kCameraNames[i]);
    }
  }
  line.pop_back();
  context_.Log(bus::Level::kInfo, line);
  done_.push_back(view);
}

std::optional<std::vector<CalibratedSetup>> CalibrationMode::Table() {
  std::vector<CalibratedSetup> table;
  for (std::size_t k = 0; k < table_size_; ++k) table.push_back({settings_[k], {}});
  for (std::size_t i = 0; i < std::size(kCameraNames); ++i) {
    std::vector<CameraCalibration> views;
    for (const View& view : done_)
      if (view.cameras[i]) views.push_back(*view.cameras[i]);
    const auto refined = ShareLens(views);
    if (!refined) {
      Fail(fmt::format("{} camera: {}", kCameraNames[i], refined.reason()));
      return std::nullopt;
    }
    double mean_error_px = 0;
    for (const auto& view : *refined)
      mean_error_px += view.mean_error_px / static_cast<double>(refined->size());
    context_.Log(bus::Level::kInfo,
                 fmt::format("{} camera: one lens for {} pictures, F {:.3f} px, k1 {:+.4f}", kCameraNames[i],
                             refined->size(), mean_error_px, refined->front().model.k1));
    for (std::size_t k = 0; k < table_size_; ++k) table[k].cameras[i] = (*refined)[k].model;
  }
  return table;
}

void CalibrationMode::Finish() {
  const auto table = Table();
  if (!table) return;
  const std::string path = context_.ResolvePath(config_.calibration);
  SaveSetups(path, *table);
  context_.Log(bus::Level::kInfo, fmt::format("{} settings calibrated, written to {}", table->size(), path));
  context_.RequestStop(0);
}

void CalibrationMode::Fail(const std::string& reason) {
  context_.Log(bus::Level::kError, "not calibrated: " + reason);
  context_.RequestStop(1);
}

}  // namespace priamos::head
