#include "head/head_app.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "head/core/drift/epipolar_shift.hpp"
#include "head/core/landmark/edge_observations.hpp"
#include "head/files/calibration_file.hpp"
#include "head/vision_options.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kMaxOrders = 16;
constexpr int kThirdWithLaser = 4 + 8;  // of a camera trigger
constexpr int kPictureWidth = 768, kPictureHeight = 576;
constexpr double kByHand_s = 0.5;  // an operator who paused for less still holds the head

LookAnswer NotFound(Verdict verdict, Time exposure) {
  LookAnswer answer;
  answer.exposure = exposure;
  answer.fix.verdict = verdict;
  return answer;
}

}  // namespace

HeadApp::HeadApp(const HeadConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      head_(config.mode == "calibrate" ? HeadModel{}
                                       : LoadHeadModel(context.ResolvePath(config.calibration))),
      positioner_(config.motors),
      watch_(config.laser),
      obstacles_(config.laser.obstacle),
      look_(config.look),
      finder_(FinderOptions(config.vision, head_)),
      edges_(EdgeOptions(config.vision)),
      drift_(config.drift),
      cameras_(context.instance() + "-camera"),
      head_state_(context.node().Subscribe(channels::kHeadState)),
      frames_(context.node().SubscribeAll(channels::kCameraFrame)),
      pose_(context.node().SubscribeAll(channels::kPose)),
      landmark_models_(context.node().SubscribeAll(channels::kLandmarkModel)),
      look_requests_(context.node().SubscribeAll(channels::kLookRequest)),
      wishes_(context.node().SubscribeAll(channels::kHeadDrive)),
      head_command_(context.node().Advertise(channels::kHeadCommand)),
      trigger_(context.node().Advertise(channels::kCameraTrigger)),
      fix_(context.node().Advertise(channels::kLandmarkFix)),
      view_(context.node().Advertise(channels::kLandmarkView)),
      obstacle_(context.node().Advertise(channels::kObstacleLine)) {
  if (config.mode == "calibrate") {
    calibration_.emplace(config, context);
    return;
  }
  // What a look needs must be known before the first one.
  for (const Camera camera : {kLeft, kRight}) {
    const auto model = head_.CameraAt(config.LookSetting(), camera);
    if (!model)
      throw ConfigError(fmt::format("{}: {} camera: {}; calibrate it with `priamos-head --calibrate`",
                                    context.ResolvePath(config.calibration), kCameraNames[camera],
                                    model.reason()));
  }
  if (config.laser.rate_hz > 0 && !head_.laser)
    throw ConfigError(
        fmt::format("{}: laser: expected the plane of the line laser for laser.rate_hz above 0, got "
                    "none; calibrate it with `priamos calibrate --laser`",
                    context.ResolvePath(config.calibration)));
}

/// Straight ahead while model or pose are unknown: the answer will say so.
double HeadApp::PanFor(const LookOrder& order, Time now) const {
  const auto model = models_.find(order.landmark_id);
  auto robot = poses_.At(now);
  if (model == models_.end() || !robot) return 0;
  robot->map_from_base = Integrate(robot->map_from_base, robot->twist, config_.aim.lead_s);
  return AimPan(head_, config_.LookSetting(), model->second, Predict(*robot, model->second.map_from_landmark),
                order.side, config_.aim);
}

void HeadApp::Tick(Time now) {
  if (calibration_) return calibration_->Tick(now);
  TakeMessages(now);
  StartNext(now);
  MoveHead(now);
  MoveByHand(now);
  Look(now);
  WatchFloor(now);
}

void HeadApp::TakeMessages(Time now) {
  if (const auto state = head_state_.Take()) report_ = FromMessage(*state);
  for (const pose_t& message : pose_.Drain()) {
    if (const auto sample = FromMessage(message)) poses_.Add(*sample);
  }
  for (const head_drive_t& message : wishes_.Drain()) jog_.Take(FromMessage(message), now);
  for (const landmark_model_t& message : landmark_models_.Drain()) {
    if (auto model = FromMessage(message)) models_[model->id] = std::move(*model);
  }
  for (const camera_frame_t& message : frames_.Drain()) {
    const FrameNotice frame = FromMessage(message);
    look_.Add(frame);
    if (watch_.Takes(frame)) TellObstacles(frame);
  }
  for (const look_request_t& message : look_requests_.Drain()) {
    orders_.push_back(FromMessage(message));
    if (orders_.size() <= kMaxOrders) continue;
    context_.Log(bus::Level::kWarning, "too many look requests at once: the oldest is refused");
    look_.End();
    Answer(NotFound(Verdict::kNoImage, now));
  }
}

void HeadApp::StartNext(Time now) {
  if (look_.active() || orders_.empty()) return;
  HeadSetting setting = config_.LookSetting();
  setting.pan_rad = PanFor(orders_.front(), now);
  positioner_.MoveTo(setting, now);
  look_.Begin(now);
}

void HeadApp::MoveHead(Time now) {
  if (const auto setting = positioner_.Step(report_ ? &*report_ : nullptr, now)) {
    head_command_.Publish(ToMessage(*setting, now));
  }
}

/// A look goes before an operator's hand.
void HeadApp::MoveByHand(Time now) {
  if (look_.active() || !report_) return jog_.Stop();
  const auto setting = jog_.Step(report_->setting, now);
  if (!setting) return;
  positioner_.Release();
  by_hand_ = now;
  head_command_.Publish(ToMessage(*setting, now));
}

void HeadApp::Look(Time now) {
  switch (look_.Step(positioner_.settled(), positioner_.failed(), now)) {
    case LookSequence::Action::kWait:
      return;
    case LookSequence::Action::kTrigger:
      trigger_.Publish(TriggerMessage(look_.frame_id(), look_.camera_mask(), now));
      return;
    case LookSequence::Action::kGiveUp:
      context_.Log(bus::Level::kWarning, positioner_.failed() ? "the head did not reach its setting"
                                                              : "no stereo pair arrived from the cameras");
      look_.End();
      Answer(NotFound(Verdict::kNoImage, now));
      return;
    case LookSequence::Action::kUseFrames: {
      LookAnswer answer = Evaluate(look_.frames());
      look_.End();
      Answer(std::move(answer));
    }
  }
}

bool HeadApp::SeesLaser() const {
  if (!head_.laser || !report_ || report_->moving) return false;
  const auto camera = head_.CameraAt(report_->setting, kThird);
  return camera && SeesLine(*camera, *head_.laser, kPictureWidth, kPictureHeight);
}

/// Between looks the third camera watches the laser's line.
void HeadApp::WatchFloor(Time now) {
  if (config_.laser.rate_hz <= 0) return;
  const bool by_hand = by_hand_ && Seconds(now - *by_hand_) < kByHand_s;
  switch (watch_.Step(look_.active() || !orders_.empty() || by_hand, SeesLaser(), now)) {
    case LaserWatch::Action::kWait:
      return;
    case LaserWatch::Action::kLower:
      return positioner_.MoveTo(config_.WatchSetting(), now);
    case LaserWatch::Action::kTrigger:
      trigger_.Publish(TriggerMessage(watch_.frame_id(), kThirdWithLaser, now));
  }
}

void HeadApp::TellObstacles(const FrameNotice& frame) {
  const auto camera = head_.CameraAt(report_->setting, kThird);
  const auto picture = cameras_.Read(frame);
  if (!camera || !picture) return;
  const ObstacleLines lines = obstacles_.Find(*picture, *camera, *head_.laser);
  obstacle_.Publish(ToMessage(lines, frame.exposure));
  if (lines.verdict == ObstacleLines::kObstacle && told_ != lines.verdict) {
    const auto worst = std::max_element(
        lines.pieces.begin(), lines.pieces.end(),
        [](const auto& a, const auto& b) { return std::abs(a.height_m) < std::abs(b.height_m); });
    context_.Log(bus::Level::kInfo, fmt::format("obstacle {:.1f} m ahead, {:+.3f} m against the floor",
                                                worst->left.x(), worst->height_m));
  }
  told_ = lines.verdict;
}

LookAnswer HeadApp::Evaluate(const Frames& frames) {
  const Time exposure = frames[0].exposure;
  const auto model = models_.find(orders_.front().landmark_id);
  if (model == models_.end()) return NotFound(Verdict::kNoModel, exposure);
  const auto robot = poses_.At(exposure);
  if (!robot) return NotFound(Verdict::kNoPose, exposure);
  std::array<EdgeImage, 2> edges;
  for (int i = 0; i < 2; ++i) {
    auto image = cameras_.Read(frames[i]);
    if (!image || image->width < 64 || image->height < 64) return NotFound(Verdict::kNoImage, exposure);
    edges_.Extract(cv::Mat(image->height, image->width, CV_8UC1, image->pixels.data()), edges[i]);
  }
  // Where the motors stand, not where they were sent: counters have steps.
  const auto left = head_.CameraAt(report_->setting, kLeft), right = head_.CameraAt(report_->setting, kRight);
  if (!left || !right) return NotFound(Verdict::kNoImage, exposure);
  LookAnswer answer;
  answer.exposure = exposure;
  const LandmarkPrediction expected = Predict(*robot, model->second.map_from_landmark);
  answer.fix = finder_.Find(model->second, expected, *left, *right, edges[0], edges[1]);
  const std::array<CameraView, 2> views{MakeView(*left, edges[0]), MakeView(*right, edges[1])};
  const int camera = TellingCamera(answer.fix);
  answer.view = ViewLandmark(model->second, expected, answer.fix, views[camera], camera);
  WatchDrift(model->second, answer.fix, views);
  return answer;
}

/// Edges tell whether both cameras are still where the calibration says: all of them about up and down, those
/// of a landmark that was found (or fits badly) about the other turns, too.
void HeadApp::WatchDrift(const LandmarkModel& model, const LandmarkFix& fix,
                         const std::array<CameraView, 2>& views) {
  if (IsBlind(*views[0].edges) || IsBlind(*views[1].edges)) return;
  const CameraModel &left = *views[0].camera, &right = *views[1].camera;
  std::optional<StereoDrift> drift;
  if (fix.verdict == Verdict::kFound || fix.verdict == Verdict::kResidualTooLarge) {
    const Eigen::Isometry3d at = Lift(fix.base_from_landmark);
    Association association;
    association.matches = fix.matches;
    StereoDriftOptions options;
    options.model_sigma_m = config_.vision.model_sigma_m;
    options.calibration_sigma_px = config_.drift.calibration_sigma_px;
    drift = MeasureDrift(model, Observations(model, association, views, at, false), left, right, at, options);
  }
  const auto shift = MeasureEpipolarShift(views[0], views[1], MatchBinocular(views[0], views[1], {}));
  if (shift) drift = Fuse(drift.value_or(UnknownDrift()), *shift, right);
  if (drift) Judge(*drift);
}

void HeadApp::Judge(const StereoDrift& drift) {
  const bool was_well = !drift_.alarm();
  drift_.Add(drift);
  if (!drift_.alarm()) return context_.SetHealth(bus::Health::kOk);
  context_.SetHealth(bus::Health::kDegraded, drift_.alarm()->ToText());
  if (was_well) context_.Log(bus::Level::kWarning, drift_.alarm()->ToText());
}

void HeadApp::Answer(LookAnswer answer) {
  answer.order = orders_.front();
  orders_.pop_front();
  const LookOrder& order = answer.order;
  const LandmarkFix& fix = answer.fix;
  if (const auto model = models_.find(order.landmark_id); model != models_.end())
    answer.map_from_landmark = model->second.map_from_landmark;
  fix_.Publish(ToMessage(answer));
  view_.Publish(ViewMessage(answer));
  if (fix.verdict != Verdict::kFound) {
    context_.Log(bus::Level::kWarning, fmt::format("look {}: landmark {} not found: {}", order.request_id,
                                                   order.landmark_id, Describe(fix.verdict)));
    return;
  }
  context_.Log(
      bus::Level::kInfo,
      fmt::format("look {}: landmark {} at ({:.3f}, {:.3f}) m, {:.2f} deg; {} edges, {:.2f} px",
                  order.request_id, order.landmark_id, fix.base_from_landmark.x, fix.base_from_landmark.y,
                  Degrees(fix.base_from_landmark.yaw), fix.n_matched, fix.residual_px));
}

}  // namespace priamos::head
