#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bus/context.hpp"
#include "head/camera_reader.hpp"
#include "head/core/calibrated_setup.hpp"
#include "head/core/calibration/camera_calibration.hpp"
#include "head/core/head_positioner.hpp"
#include "head/core/look_sequence.hpp"
#include "head/head_config.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::head {

/// `priamos-head --calibrate`: goes through the head settings of the configuration before the reference
/// object, takes a stereo pair at each, and writes the table of calibrated cameras. A setting at which a
/// camera cannot be calibrated ends it with the reason and exit code 1; the old table stays.
class CalibrationMode {
 public:
  CalibrationMode(const HeadConfig& config, bus::Context& context);

  void Tick(Time now);

 private:
  /// What both cameras saw at one setting; nothing for a camera that did not see the object whole.
  struct View {
    HeadSetting setting;
    std::array<std::optional<CameraCalibration>, 2> cameras;
  };

  void TakeMessages();
  void Look(Time now);
  void Calibrate(const FramePair& pair);
  std::optional<std::vector<CalibratedSetup>> Table();
  void Finish();
  void Fail(const std::string& reason);

  HeadConfig config_;
  bus::Context& context_;
  ReferenceObject object_;
  DiscLabeller labeller_;
  Eigen::Isometry3d base_from_object_;
  std::vector<HeadSetting> settings_;  ///< those of the table, then the sweep
  std::size_t table_size_;
  std::vector<View> done_;
  HeadPositioner positioner_;
  LookSequence look_;
  CameraReader cameras_;
  std::optional<HeadReport> report_;

  bus::Latest<head_state_t> head_state_;
  bus::Inbox<camera_frame_t> frames_;
  bus::Publisher<head_command_t> head_command_;
  bus::Publisher<camera_trigger_t> trigger_;
};

}  // namespace priamos::head
