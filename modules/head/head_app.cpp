#include "head/head_app.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "common/archive.hpp"
#include "common/robot/camera_bits.hpp"
#include "head/files/calibration_file.hpp"
#include "head/vision_options.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kMaxOrders = 16;

/// The third camera takes part where it is calibrated at all.
int CamerasOf(const HeadConfig& config, const HeadModel& head) {
  return config.vision.third_camera && head.CameraAt(config.LookSetting(), kThird) ? kCameras
                                                                                   : LookSequence::kPair;
}

std::vector<UprightTarget> TargetsOf(const FarEdges& far) {
  std::vector<UprightTarget> targets;
  targets.reserve(far.edges().size());
  for (const FarEdge& edge : far.edges()) targets.push_back({edge.at, edge.bottom_m, edge.top_m});
  return targets;
}

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
      floor_(config, head_, context),
      follow_(config.follow),
      look_(config.look, CamerasOf(config, head_),
            config.pictures.empty() ? LookSequence::Exposures::kOwn : LookSequence::Exposures::kRecorded),
      evaluator_(head_, EvaluatorOptions(config, head_)),
      glances_(config, head_, context),
      drift_(config.drift),
      pictures_(config, context),
      head_state_(context.node().Subscribe(channels::kHeadState)),
      frames_(context.node().SubscribeAll(channels::kCameraFrame)),
      pose_(context.node().SubscribeAll(channels::kPose)),
      landmark_models_(context.node().SubscribeAll(channels::kLandmarkModel)),
      look_requests_(context.node().SubscribeAll(channels::kLookRequest)),
      wishes_(context.node().SubscribeAll(channels::kHeadDrive)),
      aims_(context.node().SubscribeAll(channels::kHeadAim)),
      head_command_(context.node().Advertise(channels::kHeadCommand)),
      trigger_(context.node().Advertise(channels::kCameraTrigger)),
      fix_(context.node().Advertise(channels::kLandmarkFix)),
      door_seen_(context.node().Advertise(channels::kDoorSeen)),
      view_(context.node().Advertise(channels::kLandmarkView)) {
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
  OpenVideo();
}

/// The log goes on to its next look: the picture of this one is lost.
void HeadApp::EndWithoutPictures(Time now) {
  lost_ = false;
  if (!look_.active() || glancing_) return;
  context_.Log(bus::Level::kWarning, "its pictures are not in the folder");
  look_.End();
  Answer(NotFound(Verdict::kNoImage, now));
}

/// nullopt while model or pose are unknown, which the answer reports.
std::optional<LookWish> HeadApp::WishOf(const LookOrder& order, Time now) const {
  const auto model = models_.find(order.landmark_id);
  const auto robot = poses_.At(now);
  if (model == models_.end() || !robot) return std::nullopt;
  return LookWish{model->second, *robot, order.side};
}

HeadSetting HeadApp::SettingOf(const LookOrder& order, Time now) {
  const auto wish = WishOf(order, now);
  const GazeConfig gaze = config_.Gaze();
  if (beyond_) {
    // Further on as it was: turning takes longer than looking.
    if (!beyond_at_ && wish)
      beyond_at_ = SettingBeyond(head_, *wish, TargetsOf(evaluator_.Beyond(order.landmark_id)), gaze);
    return beyond_at_.value_or(gaze.fixed);
  }
  beyond_at_.reset();
  if (!wish) return gaze.fixed;
  HeadStanding standing;
  const bool same_side =
      looked_at_ && looked_at_->landmark_id == order.landmark_id && looked_at_->side == order.side;
  if (same_side && positioner_.settled()) standing.kept = positioner_.goal();
  // Counters may rest a step beside the goal.
  if (report_) standing.here = positioner_.settled() ? positioner_.goal() : report_->setting;
  return SettingFor(head_, *wish, standing, gaze);
}

void HeadApp::Reconfigure(const HeadConfig& config) {
  config_.aim = config.aim;
  look_.set_config(config.look);
  positioner_.set_config(config.motors);
}

void HeadApp::Tick(Time now) {
  if (calibration_) return calibration_->Tick(now);
  TakeMessages(now);
  StartNext(now);
  MoveHead(now);
  MoveByHand(now);
  Look(now);
  WatchFloor(now);
  glances_.Tell(now);
  ServeVideo(now);
  ReportHealth();
}

void HeadApp::TakeMessages(Time now) {
  if (const auto state = head_state_.Take()) {
    report_ = FromMessage(*state);
    floor_.Report(report_->setting, report_->moving, report_->time);
  }
  for (const pose_t& message : pose_.Drain()) {
    const auto sample = FromMessage(message);
    if (!sample) continue;
    poses_.Add(*sample);
    glances_.OnPose(*sample);
  }
  for (const head_drive_t& message : wishes_.Drain()) jog_.Take(FromMessage(message), now);
  for (const head_aim_t& message : aims_.Drain()) aim_.Take(FromMessage(message), now);
  for (const landmark_model_t& message : landmark_models_.Drain()) {
    if (auto model = FromMessage(message)) models_[model->id] = std::move(*model);
  }
  for (const camera_frame_t& message : frames_.Drain()) {
    const FrameNotice frame = FromMessage(message);
    if (pictures_.WasUsed(frame))
      look_.Add(frame);
    else
      lost_ = look_.active();
    if (const auto setting = floor_.Takes(frame))
      floor_.Evaluate(pictures_.Read(frame), *setting, frame.exposure);
    if (video_ && video_->Takes(frame)) ShowVideo(frame);
  }
  for (const look_request_t& message : look_requests_.Drain()) {
    if (lost_) EndWithoutPictures(now);
    if (std::exchange(following_, false)) {
      orders_.pop_front();  // an order has the head at once
      beyond_ = false;
      look_.End();
    }
    orders_.push_back(FromMessage(message));
    if (orders_.size() <= kMaxOrders) continue;
    context_.LogRefusal(channels::kLookRequest.name, "too many look requests at once: the oldest is refused");
    EndGlance();
    Answer(NotFound(Verdict::kNoImage, now));
  }
}

void HeadApp::StartNext(Time now) {
  if (look_.active() && !glancing_) {
    const auto wish = WishOf(orders_.front(), now);
    if (wish && DistanceTo(*wish) < config_.look.near_m) glances_.Defer(now);
    return;
  }
  Follow(now);
  if (orders_.empty()) return GlanceAround(now);
  glancing_ = false;  // an order has the head at once
  if (!following_) beyond_ = follow_.GoesBeyond(ApproachOf(orders_.front(), now));
  positioner_.MoveTo(SettingOf(orders_.front(), now), now);
  looked_at_ = orders_.front();
  beyond_ ? look_.Begin(now, LookSequence::kPair) : look_.Begin(now);
}

/// Infinitely far where nobody knows the landmark or the pose.
Approach HeadApp::ApproachOf(const LookOrder& order, Time now) {
  const auto wish = WishOf(order, now);
  if (!wish) return {std::numeric_limits<double>::infinity(), 0, false};
  return ApproachTo(*wish, evaluator_.Beyond(order.landmark_id).edges().size());
}

/// Looks again at what was found from near, or at what stands beyond it.
void HeadApp::Follow(Time now) {
  if (!orders_.empty() || !looked_at_) return;
  const Following next = follow_.Due(ApproachOf(*looked_at_, now), now);
  following_ = next != Following::kNothing;
  beyond_ = next == Following::kBeyond;
  if (following_) orders_.push_back(*looked_at_);
}

void HeadApp::GlanceAround(Time now) {
  const bool by_hand = jog_.IsHeld(now);
  if (glancing_ && by_hand) EndGlance();
  const auto setting = glances_.Next(by_hand, glancing_, now);
  if (!setting) return;
  glancing_ = true;
  looked_at_.reset();
  positioner_.MoveTo(*setting, now);
  glances_.is_aside() ? look_.Begin(now, LookSequence::kPair) : look_.Begin(now);
}

void HeadApp::EndGlance() {
  glancing_ = false;
  look_.End();
}

/// What a glance shows; of one that shows nothing, nothing is said.
void HeadApp::UseGlance() {
  const Frames frames = look_.frames();
  if (const auto robot = poses_.At(frames[kLeft].exposure))
    glances_.Add({pictures_.Read(frames[kLeft]), pictures_.Read(frames[kRight]),
                  frames.size() > kThird ? pictures_.Read(frames[kThird]) : std::nullopt},
                 report_->setting, *robot);
  EndGlance();
}

void HeadApp::MoveHead(Time now) {
  if (const auto setting = positioner_.Step(report_ ? &*report_ : nullptr, now)) {
    head_command_.Publish(ToMessage(*setting, now));
  }
}

/// A look goes before an operator's hand.
void HeadApp::MoveByHand(Time now) {
  if (look_.active() || !report_) return jog_.Stop();
  if (const auto aim = aim_.Next(report_->setting, now)) {
    looked_at_.reset();
    positioner_.MoveTo(*aim, now);
  }
  const auto setting = jog_.Step(report_->setting, now);
  if (!setting) return;
  positioner_.Release();
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
      if (glancing_) return EndGlance();
      if (beyond_) return AnswerBeyond(NotFound(Verdict::kNoImage, now).fix, now);
      context_.Log(bus::Level::kWarning, positioner_.failed() ? "the head did not reach its setting"
                                                              : "no stereo pair arrived from the cameras");
      look_.End();
      Answer(NotFound(Verdict::kNoImage, now));
      return;
    case LookSequence::Action::kUseFrames: {
      lost_ = false;
      if (glancing_) return UseGlance();
      if (beyond_) {
        const LandmarkFix fix = evaluator_.SeeBeyond(InputOf(look_.frames()));
        return AnswerBeyond(fix, look_.frames()[kLeft].exposure);
      }
      LookAnswer answer = Evaluate(look_.frames());
      look_.End();
      Answer(std::move(answer));
    }
  }
}

void HeadApp::WatchFloor(Time now) {
  const bool by_hand = jog_.IsHeld(now);
  // Who drives needs looks or glances: the head stays ready for them.
  const bool needed =
      look_.active() || !orders_.empty() || by_hand || aim_.IsHeld(now) || glances_.LooksWhereItDrives();
  std::optional<HeadSetting> rests_at;
  if (report_ && !report_->moving && !by_hand && !positioner_.moving()) rests_at = report_->setting;
  switch (floor_.Step(needed, look_.exposed_at() == now, rests_at, now)) {
    case LaserWatch::Action::kWait:
      return;
    case LaserWatch::Action::kLower:
      looked_at_.reset();
      return positioner_.MoveTo(config_.WatchSetting(), now);
    case LaserWatch::Action::kTrigger:
      trigger_.Publish(TriggerMessage(floor_.frame_id(), CameraBit(kThird) | kLaserBit, now));
  }
}

/// The robot sees without it: one that cannot be opened is only reported.
void HeadApp::OpenVideo() {
  if (config_.video.port == 0 || context_.lockstep() || pictures_.recorded()) return;
  const std::string& tokens = config_.video.token_file;
  try {
    video_ = std::make_unique<VideoLink>(config_.video, context_.robot(),
                                         tokens.empty() ? "" : context_.ResolvePath(tokens));
    context_.Log(bus::Level::kInfo, fmt::format("the third camera is at {}", video_->address()));
  } catch (const std::runtime_error& error) {
    context_.Log(bus::Level::kWarning, fmt::format("no video link: {}", error.what()));
  }
}

void HeadApp::ServeVideo(Time now) {
  if (!video_ || !video_->Step(look_.active(), now)) return;
  trigger_.Publish(TriggerMessage(video_->frame_id(), CameraBit(kThird), now));
}

void HeadApp::ShowVideo(const FrameNotice& frame) {
  if (const auto picture = pictures_.Show(frame)) video_->Show(frame.exposure, *picture);
}

LookInput HeadApp::InputOf(const Frames& frames) {
  const auto model = models_.find(orders_.front().landmark_id);
  return {model == models_.end() ? nullptr : &model->second,
          poses_.At(frames[kLeft].exposure),
          {pictures_.Read(frames[kLeft]), pictures_.Read(frames[kRight])},
          report_->setting,
          frames.size() > kThird ? pictures_.Read(frames[kThird]) : std::nullopt};
}

LookAnswer HeadApp::Evaluate(const Frames& frames) {
  LookAnswer answer;
  answer.exposure = frames[kLeft].exposure;
  LookResult result = evaluator_.Evaluate(InputOf(frames));
  answer.fix = std::move(result.fix);
  answer.view = std::move(result.view);
  answer.leaf = result.leaf;
  answer.n_third = result.n_third;
  if (result.drift) Judge(*result.drift);
  if (const auto robot = poses_.At(answer.exposure)) glances_.Add(result.scene, *robot);
  return answer;
}

/// A camera that has moved makes fixes wrong; a picture that is not kept only makes the log poorer.
void HeadApp::ReportHealth() {
  if (drift_.alarm()) return context_.SetHealth(bus::Health::kDegraded, drift_.alarm()->ToText());
  if (pictures_.n_not_kept() == 0) return context_.SetHealth(bus::Health::kOk);
  context_.SetHealth(bus::Health::kDegraded,
                     fmt::format("{} pictures could not be kept", pictures_.n_not_kept()));
}

void HeadApp::Judge(const StereoDrift& drift) {
  const bool was_well = !drift_.alarm();
  drift_.Add(drift);
  if (was_well && drift_.alarm()) context_.Log(bus::Level::kWarning, drift_.alarm()->ToText());
}

/// It is answered as a look at the landmark is, but shows nothing of that.
void HeadApp::AnswerBeyond(const LandmarkFix& fix, Time exposure) {
  LookAnswer answer;
  answer.order = orders_.front();
  answer.exposure = exposure;
  answer.fix = fix;
  orders_.pop_front();
  look_.End();
  beyond_ = false;
  const bool followed = std::exchange(following_, false), found = fix.verdict == Verdict::kFound;
  follow_.AnsweredBeyond(found, exposure);
  if (followed && !found) return;  // nobody waits for it
  const LookOrder& order = answer.order;
  answer.map_from_landmark = models_.at(order.landmark_id).map_from_landmark;
  fix_.Publish(ToMessage(answer));
  const std::string text =
      found ? fmt::format("{:.2f} deg by {} edges", Degrees(fix.base_from_landmark.yaw), fix.n_matched)
            : fmt::format("nothing that tells a heading: {}", Describe(fix.verdict));
  context_.Log(found ? bus::Level::kInfo : bus::Level::kWarning,
               fmt::format("look {}: beyond landmark {}: {}", order.request_id, order.landmark_id, text));
}

void HeadApp::Answer(LookAnswer answer) {
  answer.order = orders_.front();
  orders_.pop_front();
  const LookOrder& order = answer.order;
  const LandmarkFix& fix = answer.fix;
  const bool followed = std::exchange(following_, false), found = fix.verdict == Verdict::kFound;
  beyond_ = false;
  follow_.Answered(found, answer.exposure);
  if (followed && !found) return;  // nobody waits for it
  if (const auto model = models_.find(order.landmark_id); model != models_.end())
    answer.map_from_landmark = model->second.map_from_landmark;
  fix_.Publish(ToMessage(answer));
  if (const auto seen = DoorSeenMessage(answer)) door_seen_.Publish(*seen);
  view_.Publish(ViewMessage(answer));
  if (!found) {
    context_.Log(bus::Level::kWarning, fmt::format("look {}: landmark {} not found: {}", order.request_id,
                                                   order.landmark_id, Describe(fix.verdict)));
    return;
  }
  context_.Log(
      bus::Level::kInfo,
      fmt::format("look {}: landmark {} at ({:.3f}, {:.3f}) m, {:.2f} deg; {} edges, {} of the third camera, "
                  "{:.2f} px",
                  order.request_id, order.landmark_id, fix.base_from_landmark.x, fix.base_from_landmark.y,
                  Degrees(fix.base_from_landmark.yaw), fix.n_matched, answer.n_third, fix.residual_px));
}

}  // namespace priamos::head
