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
      positioner_(config.motors),
      look_(config.look),
      cameras_(context.instance() + "-camera"),
      head_state_(context.node().Subscribe(channels::kHeadState)),
      frames_(context.node().SubscribeAll(channels::kCameraFrame)),
      head_command_(context.node().Advertise(channels::kHeadCommand)),
      trigger_(context.node().Advertise(channels::kCameraTrigger)) {}

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
  CalibratedSetup setup{settings_[done_.size()], {}};
  std::string line = fmt::format("setting {} of {}, pan {:+.1f} degrees:", done_.size() + 1, settings_.size(),
                                 Degrees(setup.setting.pan_rad));
  for (std::size_t i = 0; i < pair.size(); ++i) {
    const auto image = cameras_.Read(pair[i]);
    if (!image) return Fail("a picture was not in the frame store");
    const auto camera = CalibrateCamera(*image, object_, labeller_, base_from_object_);
    if (!camera)
      return Fail(fmt::format("{} camera, pan {:.1f} degrees: {}", kCameraNames[i],
                              Degrees(setup.setting.pan_rad), camera.reason()));
    setup.cameras[i] = camera->model;
    line += fmt::format(" {} {} discs, F {:.3f} px;", kCameraNames[i], camera->discs, camera->mean_error_px);
  }
  line.pop_back();
  context_.Log(bus::Level::kInfo, line);
  done_.push_back(setup);
}

void CalibrationMode::Finish() {
  const std::string path = context_.ResolvePath(config_.calibration);
  SaveSetups(path, done_);
  context_.Log(bus::Level::kInfo, fmt::format("{} settings calibrated, written to {}", done_.size(), path));
  context_.RequestStop(0);
}

void CalibrationMode::Fail(const std::string& reason) {
  context_.Log(bus::Level::kError, "not calibrated: " + reason);
  context_.RequestStop(1);
}

}  // namespace priamos::head
