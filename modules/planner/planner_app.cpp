#include "planner/planner_app.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/config.hpp"
#include "planner/agenda_messages.hpp"
#include "planner/core/map/map_landmarks.hpp"
#include "planner/planner_messages.hpp"

namespace priamos::planner {

PlannerApp::PlannerApp(const PlannerConfig& config, bus::Context& context, MissionMaker missions)
    : config_(config),
      context_(context),
      plan_(LoadConfig<GroundPlan>(context.ResolvePath(config.map))),
      missions_(missions(config, plan_)),
      map_(config, context),
      router_(MakeRouter(config, plan_)),
      models_(FromSeconds(config.model_period_s)),
      agenda_(MakeAgenda(config, missions_, router_)),
      orders_(context.node().SubscribeAll(channels::kMissionCommand)),
      poses_(context.node().Subscribe(channels::kPose)),
      drive_(context.node().Subscribe(channels::kDriveStatus)),
      fixes_(context.node().SubscribeAll(channels::kLandmarkFix)),
      corrections_(context.node().SubscribeAll(channels::kPoseCorrection)),
      openings_(context.node().SubscribeAll(channels::kOpening)),
      leaves_(context.node().SubscribeAll(channels::kDoorSeen)),
      link_(context.node().Subscribe(channels::kLinkStatus)),
      model_(context.node().Advertise(channels::kLandmarkModel)),
      look_(context.node().Advertise(channels::kLookRequest)),
      walls_(context.node().Advertise(channels::kPlanWalls)),
      path_(context.node().Advertise(channels::kPath)),
      place_(context.node().Advertise(channels::kPoseReset)),
      status_(context.node().Advertise(channels::kMissionStatus)),
      status_rate_(config.status_rate_hz),
      floor_(context) {
  missions_.OnLearned(map_.walls());
}

void PlannerApp::Tick(Time now) {
  TakeReports(now);
  if (auto learned = map_.Tick(now)) missions_.OnLearned(std::move(learned));
  for (const SeenFeature& seen : map_.TakeTold()) missions_.OnTold(seen);
  TakeOrders(now);
  Send(agenda_.Tick(now), now);
  SendStatus(now);
  if (floor_.Due(now)) floor_.Send(*map_.walls(), SeenOf(missions_), now);
}

void PlannerApp::Reconfigure(const PlannerConfig& config) {
  planner::Reconfigure(missions_, config);
  agenda_.set_speeds(SpeedsOf(config));
}

void PlannerApp::TakeOrders(Time now) {
  for (const auto& order : orders_.Drain()) Take(order, now);
}

void PlannerApp::Take(const mission_command_t& order, Time now) {
  switch (order.mission) {
    case mission_command_t::ABORT:
      return agenda_.Abort(now, order.order_id);
    case mission_command_t::PAUSE:
      return void(agenda_.Pause(now));
    case mission_command_t::RESUME:
      return void(agenda_.Resume(now));
    case mission_command_t::CANCEL:
      return void(agenda_.Cancel(order.order_id));
    default:
      if (const auto refusal = agenda_.Take(OrderIn(order), now))
        context_.LogRefusal(channels::kMissionCommand.name, "order refused: " + refusal->reason);
  }
}

void PlannerApp::TakeReports(Time now) {
  const auto* link = link_.get();
  missions_.OnLink(link && link->up && link_.Age(now) < channels::kLinkStatus.stale_after);
  if (const auto pose = poses_.Take()) missions_.OnPose(FromMessage(*pose));
  if (const auto drive = drive_.Take()) missions_.OnDrive(FromMessage(*drive), now);
  for (const auto& opening : openings_.Drain()) missions_.OnOpening(FromMessage(opening));
  for (const auto& leaf : leaves_.Drain()) missions_.OnLeaf(FromMessage(leaf));
  for (const auto& fix : fixes_.Drain()) {
    if (const auto failure = FromMessage(fix)) missions_.OnLook(*failure);
    if (fix.verdict == landmark_fix_t::NO_MODEL) TeachLandmark(fix.landmark_id, now);
  }
  for (const auto& correction : corrections_.Drain()) {
    missions_.OnLook(FromMessage(correction));
    const bool changed =
        correction.verdict == pose_correction_t::APPLIED || correction.verdict == pose_correction_t::RESET;
    if (changed) missions_.OnCorrected(FromUtime(correction.utime));
  }
}

/// Somebody else than a mission, which sends its own, has the head look at a landmark of which it has no
/// model.
void PlannerApp::TeachLandmark(int id, Time now) {
  if (agenda_.running()) return;
  if (auto landmark = MakeLandmark(plan_, id)) models_.Want(std::move(*landmark), now);
}

void PlannerApp::Send(const MissionActions& actions, Time now) {
  if (actions.model) models_.Want(*actions.model, now);
  if (const auto model = models_.Next(now)) model_.Publish(ToMessage(*model));
  if (actions.faces) walls_.Publish(ToMessage(*actions.faces, plan_.wall_sigma_m));
  if (actions.path) path_.Publish(ToMessage(*actions.path, now));
  if (actions.look) look_.Publish(ToMessage(*actions.look, now));
  if (actions.place) place_.Publish(ToMessage(*actions.place, now));
  if (actions.map) map_.Replace(*actions.map);
}

void PlannerApp::SendStatus(Time now) {
  const bool new_words = !(agenda_.state() == sent_state_);
  if (!new_words && agenda_.changes() == sent_changes_ && !status_rate_.Due(now)) return;
  if (new_words) context_.Log(bus::Level::kInfo, agenda_.state().text);
  SendEnds(now);
  sent_state_ = agenda_.state();
  sent_changes_ = agenda_.changes();
  status_rate_.Mark(now);
}

/// One status, or as many as it takes to show every end since the last one: somebody may wait for each.
void PlannerApp::SendEnds(Time now) {
  const std::size_t n_new = std::min(agenda_.n_ended() - sent_ends_, agenda_.results().size());
  for (std::size_t n_shown = kShownResults; n_shown < n_new; n_shown += kShownResults)
    status_.Publish(StatusOf(agenda_, now, n_new - n_shown));
  status_.Publish(StatusOf(agenda_, now));
  sent_ends_ = agenda_.n_ended();
}

}  // namespace priamos::planner
