#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/context.hpp"
#include "head/camera_reader.hpp"
#include "head/core/calibration/correspondence/correspondence.hpp"
#include "head/core/calibration/rig/head_solver.hpp"
#include "head/core/motion/head_positioner.hpp"
#include "head/core/motion/look_sequence.hpp"
#include "head/files/calibration_journal.hpp"
#include "head/head_config.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::head {

/// Process `priamos-head --calibrate`: goes through the settings of the plan before the reference object,
/// exposes all three cameras at each, and calibrates mechanics and lenses together. It needs nobody: a
/// setting is always approached from the same side, what is finished is kept in a journal beside the table,
/// and an interrupted calibration goes on from there. Anything that keeps it from a good table ends it with
/// the reason and exit code 1; the old table stays.
class CalibrationMode {
 public:
  CalibrationMode(const HeadConfig& config, bus::Context& context);

  void Tick(Time now);

 private:
  void TakeMessages();
  void Look(Time now);
  void Use(const Frames& frames, Time now);
  std::vector<SeenDisc> Recognise(const FrameNotice& frame, std::string& note);
  std::vector<HeadView> Views() const;
  void Finish();
  void Fail(const std::string& reason);

  HeadConfig config_;
  bus::Context& context_;
  std::string table_path_;
  ReferenceObject object_, object_in_base_;
  DiscLabeller labeller_;
  std::vector<HeadSetting> settings_;
  CalibrationJournal journal_;
  std::vector<CalibrationExposure> done_;
  std::size_t resumed_ = 0;  ///< so many of them are from an earlier run
  std::optional<Time> begun_;
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
