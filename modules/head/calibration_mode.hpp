#pragma once

#include <optional>
#include <vector>

#include "bus/context.hpp"
#include "head/camera_reader.hpp"
#include "head/core/calibrated_setup.hpp"
#include "head/core/calibration/correspondence.hpp"
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
  void TakeMessages();
  void Look(Time now);
  void Calibrate(const FramePair& pair);
  void Finish();
  void Fail(const std::string& reason);

  HeadConfig config_;
  bus::Context& context_;
  ReferenceObject object_;
  DiscLabeller labeller_;
  Eigen::Isometry3d base_from_object_;
  std::vector<HeadSetting> settings_;
  std::vector<CalibratedSetup> done_;
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
