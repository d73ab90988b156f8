#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <vector>

#include "bus/context.hpp"
#include "bus/own_types.hpp"
#include "head/files/calibration_file.hpp"
#include "head/head_config.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::head {

/// A process of the head on a bus of its own; motors and cameras are played by hand. `Dut` is what has
/// Tick(now) and is made from configuration and context.
template <class Dut>
struct HeadOnABench {
  explicit HeadOnABench(HeadConfig config = {}, const HeadModel& table = NearlyDrawn()) {
    config.calibration = folder / "kastor.yaml";
    SaveHeadModel(config.calibration, table);
    Restart(config);
  }
  /// Without a table.
  struct Bare {};
  HeadOnABench(const HeadConfig& config, Bare) { Restart(config); }

  /// The head as drawn, calibrated at the setting of all looks alone.
  static HeadModel NearlyDrawn() {
    const HeadConfig config;
    HeadModel model;
    for (LensTable& lens : model.lenses)
      lens = LensTable({config.zoom_step}, {config.focus_step}, {{1000, {383.5, 287.5}, -0.05, 0, 0.02}});
    return model;
  }

  void Restart(const HeadConfig& config) { dut.emplace(config, context); }

  void Step() {
    clock.Set(clock.Now() + std::chrono::milliseconds(20));
    if (motors_report) SendState();
    if (position_known) SendPose();
    bus.Drain();
    dut->Tick(clock.Now());
    bus.Drain();
    if (const auto message = command.Take()) {
      commands.push_back(*message);
      if (motors_obey) counters = *message;
    }
    for (const camera_trigger_t& message : trigger_inbox.Drain()) {
      triggers.push_back(message);
      if (cameras_answer) Expose(message);
    }
  }
  void Run(double seconds) {
    for (int i = 0; i < seconds * 50; ++i) Step();
  }

  void SendState() {
    head_state_t message{};
    message.utime = ToUtime(clock.Now());
    message.pan_rad = counters.pan_rad;
    message.tilt_rad = counters.tilt_rad;
    for (int i = 0; i < 2; ++i) {
      message.vergence_rad[i] = counters.vergence_rad[i];
      message.zoom_step[i] = counters.zoom_step[i];
      message.focus_step[i] = counters.focus_step[i];
    }
    states.Publish(message);
  }
  void SendPose() {
    pose_t message{};
    message.utime = ToUtime(clock.Now());
    message.sigma_x_m = message.sigma_y_m = 0.01;
    message.sigma_yaw_rad = 0.005;
    poses.Publish(message);
  }
  void Expose(const camera_trigger_t& asked) {
    for (int c = 0; c < 3; ++c) {
      if (!(asked.cameras & 1 << c)) continue;
      camera_frame_t message{};
      message.utime_exposure = ToUtime(clock.Now());
      message.frame_id = asked.frame_id;
      message.camera = static_cast<std::int8_t>(c);
      message.width_px = static_cast<std::int16_t>(picture.width);
      message.height_px = static_cast<std::int16_t>(picture.height);
      message.slot = static_cast<std::int16_t>(store.Write(asked.frame_id, picture));
      frames.Publish(message);
    }
  }
  void SendLook(int request_id, int landmark_id) {
    look_request_t message{};
    message.utime = ToUtime(clock.Now());
    message.request_id = request_id;
    message.landmark_id = static_cast<std::int16_t>(landmark_id);
    looks.Publish(message);
  }
  /// An upright board of two metres, `x_m` ahead of the robot's start and `y_m` to its left.
  void SendBoard(int landmark_id, double x_m, double y_m) {
    landmark_model_t message{};
    message.landmark_id = static_cast<std::int16_t>(landmark_id);
    message.x_m = x_m;
    message.y_m = y_m;
    for (const double side : {-0.4, 0.4}) {
      landmark_edge_t edge{};
      edge.y1_m = edge.y2_m = side;
      edge.z2_m = 2;
      edge.visible_from_rad = -3.14;
      edge.visible_to_rad = 3.14;
      message.edges.push_back(edge);
    }
    message.n_edges = 2;
    models.Publish(message);
  }
  /// The stick is held to the left for a moment.
  void SendHand(double pan_rad_s) {
    head_drive_t message{};
    message.utime = ToUtime(clock.Now());
    message.session = 3;
    message.sequence = ++sequence;
    message.time_to_live_s = 0.2;
    message.pan_rad_s = pan_rad_s;
    hands.Publish(message);
  }
  /// Whether a line of the log has this text.
  bool Logged(const std::string& text) const {
    for (const std::string& line : log)
      if (line.find(text) != std::string::npos) return true;
    return false;
  }

  bool motors_report = true, motors_obey = true, cameras_answer = true, position_known = false;
  GreyImage picture{768, 576, std::vector<std::uint8_t>(768 * 576, 0)};  ///< of every camera: all black
  int sequence = 0;
  head_command_t counters{};  ///< where the motors are
  std::vector<head_command_t> commands;
  std::vector<camera_trigger_t> triggers;
  std::vector<std::string> log;

  TemporaryFolder folder;
  const std::string instance = fmt::format("priamos-test-bench-{}", getpid());
  FrameStore store = FrameStore::Create(instance + "-camera");
  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{FromUtime(1'000'000'000)};
  bus::LcmBus bus{"memq://"};
  bus::Node node{bus, schema, clock}, other{bus, schema, clock};
  bus::Context context{node, [this] {
                         bus::Surroundings around;
                         around.instance = instance;
                         around.config_dir = PRIAMOS_SOURCE_DIR "/config/sim";
                         around.log = [this](bus::Level, std::string_view text) { log.emplace_back(text); };
                         return around;
                       }()};
  bus::Publisher<head_state_t> states = other.Advertise(channels::kHeadState);
  bus::Publisher<pose_t> poses = other.Advertise(channels::kPose);
  bus::Publisher<camera_frame_t> frames = other.Advertise(channels::kCameraFrame);
  bus::Publisher<look_request_t> looks = other.Advertise(channels::kLookRequest);
  bus::Publisher<landmark_model_t> models = other.Advertise(channels::kLandmarkModel);
  bus::Publisher<head_drive_t> hands = other.Advertise(channels::kHeadDrive);
  bus::Latest<head_command_t> command = other.Subscribe(channels::kHeadCommand);
  bus::Inbox<camera_trigger_t> trigger_inbox = other.SubscribeAll(channels::kCameraTrigger);
  bus::Inbox<landmark_fix_t> fixes = other.SubscribeAll(channels::kLandmarkFix);
  bus::Inbox<landmark_view_t> views = other.SubscribeAll(channels::kLandmarkView);
  bus::Inbox<obstacle_line_t> obstacles = other.SubscribeAll(channels::kObstacleLine);
  std::optional<Dut> dut;
};

}  // namespace priamos::head
