#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "bus/app.hpp"
#include "bus/context.hpp"
#include "lcmtypes/channels.hpp"
#include "world/core/simulation.hpp"
#include "world/world_config.hpp"
#include "world/world_loading.hpp"

namespace priamos::world {

/// Stands in for the hardware of PRIAMOS. See README.md.
class WorldApp {
 public:
  static constexpr std::string_view kName = "world";
  static constexpr std::string_view kSummary =
      "Stands in for the hardware: wheels, sonars, KASTOR's motors and cameras, in a simulated building.";
  static constexpr bus::OptionAlias kOptions[] = {{"--world", "world", "", "world file to simulate"}};
  static constexpr bool kOneOwner = true;
  /// Channels of devices: where their drivers send, nothing may stand in for them.
  static constexpr std::array kSpeaksAlone{channels::kWheelState.name, channels::kMotorCurrent.name,
                                           channels::kBumper.name,     channels::kSonarRanges.name,
                                           channels::kHeadState.name,  channels::kCameraFrame.name};
  using Config = WorldConfig;

  /// Builds the world. Throws ConfigError when the world cannot be used, std::runtime_error without
  /// off-screen OpenGL or shared memory.
  WorldApp(const WorldConfig& config, bus::Context& context);

  Duration TickPeriod() const { return Duration(10000); }
  void Tick(Time now);

 private:
  void PublishSamples();
  void PublishFrames(Time now);
  void TakeCommands(Time now);
  void TakeWheelCommands();
  void ReportContest(const WheelReading& reading);
  std::unique_ptr<RenderExecutor> MakeExecutor(const WorldConfig& config) const;

  bus::Context& context_;
  LoadedWorld world_;
  FrameStore store_;
  std::unique_ptr<RenderExecutor> executor_;
  CameraServer cameras_;
  Simulation simulation_;

  bus::Inbox<wheel_command_t> wheel_commands_;
  bus::Inbox<head_command_t> head_commands_;
  bus::Inbox<camera_trigger_t> triggers_;
  bus::Publisher<wheel_state_t> wheels_;
  bus::Publisher<motor_current_t> currents_;
  bus::Publisher<bumper_t> bumper_;
  bus::Publisher<sonar_ranges_t> sonars_;
  bus::Publisher<head_state_t> head_;
  bus::Publisher<camera_frame_t> frames_;
  bus::Publisher<world_truth_t> truth_;
  bus::Publisher<world_touch_t> touches_;
  bool reported_contest_ = false;
};

/// What draws this world; it holds the renderer. To be called in the thread that will draw.
RenderFunction MakeRenderFunction(const LoadedWorld& world, const WorldConfig& config, std::uint64_t seed);

/// Handle on OpenGL of this thread: while it is held, worlds made one after the other in this thread need not
/// set OpenGL up again.
std::shared_ptr<void> HoldGraphics();

}  // namespace priamos::world
