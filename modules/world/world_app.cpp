#include "world/world_app.hpp"

#include <fmt/format.h>

#include "world/render_thread.hpp"
#include "world/world_messages.hpp"

namespace priamos::world {

RenderFunction MakeRenderFunction(const LoadedWorld& world, const WorldConfig& config, std::uint64_t seed) {
  RendererConfig look;
  look.scene = world.light;
  look.imaging = config.lens;
  look.head = WithQuirks(config.BuiltHead(), world.quirks);
  look.lasers = config.lasers;
  auto renderer = std::make_shared<Renderer>(look, WithPeople(world.solids, world.hazards.people), seed);
  renderer->PlaceReference(world.reference);
  return [renderer](const RenderJob& job) {
    Rng noise(job.noise_seed);
    return renderer->Expose(job.camera, job.opening, job.closing, job.exposure, noise);
  };
}

WorldApp::WorldApp(const WorldConfig& config, bus::Context& context)
    : context_(context),
      world_(LoadWorld(
          config.world, [&](const std::string& name) { return context.ResolvePath(name); },
          BodyOf(config.robot), context.seed())),
      store_(FrameStore::Create(context.instance() + "-camera")),
      executor_(MakeExecutor(config)),
      cameras_(config.robot.camera, world_.plan.camera_light, *executor_, context.seed(), world_.quirks),
      simulation_(config.robot, WithPeople(world_.solids, world_.hazards.people), world_.start.truth,
                  cameras_, context.seed(), world_.hazards),
      wheel_commands_(context.node().SubscribeAll(channels::kWheelCommand)),
      head_commands_(context.node().SubscribeAll(channels::kHeadCommand)),
      triggers_(context.node().SubscribeAll(channels::kCameraTrigger)),
      wheels_(context.node().Advertise(channels::kWheelState)),
      currents_(context.node().Advertise(channels::kMotorCurrent)),
      bumper_(context.node().Advertise(channels::kBumper)),
      sonars_(context.node().Advertise(channels::kSonarRanges)),
      head_(context.node().Advertise(channels::kHeadState)),
      frames_(context.node().Advertise(channels::kCameraFrame)),
      truth_(context.node().Advertise(channels::kWorldTruth)),
      touches_(context.node().Advertise(channels::kWorldTouch)) {
  const Pose2 start = world_.start.nominal, error = start.Inverse() * world_.start.truth;
  context.Log(bus::Level::kInfo,
              fmt::format("{}: nominal start {:.3f} m, {:.3f} m, {:.2f} deg; true start off by {:.3f} m, "
                          "{:.2f} deg (seed {})",
                          config.world, start.x, start.y, Degrees(start.yaw), error.translation().norm(),
                          Degrees(error.yaw), context.seed()));
}

std::unique_ptr<RenderExecutor> WorldApp::MakeExecutor(const WorldConfig& config) const {
  const auto make = [this, &config] { return MakeRenderFunction(world_, config, context_.seed()); };
  if (context_.lockstep()) return std::make_unique<InlineRenderExecutor>(make());
  return std::make_unique<RenderThread>(make);
}

void WorldApp::Tick(Time now) {
  const Duration skipped = simulation_.Advance(now);
  if (skipped > Duration(0))
    context_.Log(
        bus::Level::kWarning,
        fmt::format("the world stood still for {:.2f} s: this process did not run", Seconds(skipped)));
  PublishSamples();
  PublishFrames(now);
  // Last, so that a command acts from its arrival on and not before.
  TakeCommands(now);
}

void WorldApp::PublishSamples() {
  if (const auto wheels = simulation_.TakeWheels()) {
    ReportContest(wheels->reading);
    wheels_.Publish(ToMessage(*wheels));
  }
  if (const auto touch = simulation_.TakeTouch()) {
    currents_.Publish(CurrentsOf(*touch));
    bumper_.Publish(BumperOf(*touch));
  }
  if (const auto head = simulation_.TakeHead()) head_.Publish(ToMessage(*head));
  if (const auto sonars = simulation_.TakeSonars()) sonars_.Publish(ToMessage(*sonars));
  if (const auto truth = simulation_.TakeTruth()) truth_.Publish(ToMessage(*truth));
  for (const TouchEvent& touch : simulation_.TakeTouchEvents()) touches_.Publish(ToMessage(touch));
}

void WorldApp::PublishFrames(Time now) {
  try {
    while (const auto frame = cameras_.Collect(now))
      frames_.Publish(ToMessage(*frame, store_.Write(frame->frame_id, frame->image)));
  } catch (const std::exception& error) {
    // Blind, but wheels and sonars go on.
    context_.SetHealth(bus::Health::kFailed, fmt::format("no pictures: {}", error.what()));
    context_.Log(bus::Level::kError, fmt::format("a picture could not be drawn: {}", error.what()));
  }
}

void WorldApp::ReportContest(const WheelReading& reading) {
  if (reading.contested && !reported_contest_)
    context_.Log(bus::Level::kWarning,
                 "two processes command the wheels: they are held, and neither is obeyed");
  reported_contest_ = reading.contested;
}

/// All of them: who commands beside another must not be hidden by it.
void WorldApp::TakeWheelCommands() {
  for (const auto& [arrival, command] : wheel_commands_.DrainWithArrival())
    if (!simulation_.CommandWheels(arrival, command.instance, FromMessage(command)))
      context_.LogRefusal(channels::kWheelCommand.name, "wheel command refused: not a number");
}

void WorldApp::TakeCommands(Time now) {
  TakeWheelCommands();
  for (const auto& command : head_commands_.Drain())
    if (!simulation_.CommandHead(FromMessage(command)))
      context_.LogRefusal(channels::kHeadCommand.name, "head command refused: not a number");
  for (const auto& trigger : triggers_.Drain())
    if (!simulation_.Trigger(now, trigger.frame_id, trigger.cameras))
      context_.LogRefusal(channels::kCameraTrigger.name,
                          fmt::format("camera trigger {} refused: cameras busy", trigger.frame_id));
}

std::shared_ptr<void> HoldGraphics() {
  return Renderer::HoldGraphics();
}

}  // namespace priamos::world
