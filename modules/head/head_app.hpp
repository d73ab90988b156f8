#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bus/app.hpp"
#include "bus/context.hpp"
#include "head/calibration_mode.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/drift/drift_monitor.hpp"
#include "head/core/look/look_evaluator.hpp"
#include "head/core/motion/aim.hpp"
#include "head/core/motion/follow_up.hpp"
#include "head/core/motion/gaze.hpp"
#include "head/core/motion/head_aim.hpp"
#include "head/core/motion/head_jog.hpp"
#include "head/floor_watch.hpp"
#include "head/glances.hpp"
#include "head/head_config.hpp"
#include "head/head_messages.hpp"
#include "head/picture_source.hpp"
#include "head/video_link.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::head {

/// The second of the robot's two computers: the KASTOR head and its eyes. See README.md.
class HeadApp {
 public:
  static constexpr std::string_view kName = "head";
  static constexpr std::string_view kSummary =
      "The stereo head: turns the cameras, sees edges, finds landmarks, answers LOOK_REQUEST with "
      "LANDMARK_FIX.";
  static constexpr bus::OptionAlias kOptions[] = {
      {"--calibrate", "mode", "\"calibrate\"",
       "observe the reference object, write the calibration table, end"},
      {"--pictures", "pictures", "",
       "folder with the pictures of the log that is played, with --clock bus; relative to the configuration"},
      {"--keep-pictures", "keep_pictures", "",
       "keep every picture that is used in that folder, for such a log; relative to the configuration"}};
  static constexpr bool kOneOwner = true;
  static constexpr bool kFollowsLogs = true;
  using Config = HeadConfig;

  HeadApp(const HeadConfig& config, bus::Context& context);

  Duration TickPeriod() const { return FromSeconds(1 / config_.rate_hz); }
  void Tick(Time now);
  /// Takes over the parameters that HeadConfig marks as live.
  void Reconfigure(const HeadConfig& config);

 private:
  void TakeMessages(Time now);
  void StartNext(Time now);
  std::optional<LookWish> WishOf(const LookOrder& order, Time now) const;
  Approach ApproachOf(const LookOrder& order, Time now);
  void Follow(Time now);
  void GlanceAround(Time now);
  void EndGlance();
  void UseGlance();
  void MoveHead(Time now);
  void MoveByHand(Time now);
  void Look(Time now);
  void WatchFloor(Time now);
  void OpenVideo();
  void ServeVideo(Time now);
  void ShowVideo(const FrameNotice& frame);
  LookAnswer Evaluate(const Frames& frames);
  void EndWithoutPictures(Time now);
  void Judge(const StereoDrift& drift);
  void ReportHealth();
  HeadSetting SettingOf(const LookOrder& order, Time now);
  LookInput InputOf(const Frames& frames);
  void AnswerBeyond(const LandmarkFix& fix, Time exposure);
  void Answer(LookAnswer answer);

  HeadConfig config_;
  bus::Context& context_;
  std::optional<CalibrationMode> calibration_;
  HeadModel head_;
  HeadPositioner positioner_;
  HeadJog jog_;
  AimKeeper aim_;
  FloorWatch floor_;
  FollowUp follow_;
  LookSequence look_;
  LookEvaluator evaluator_;
  Glances glances_;
  bool glancing_ = false;  ///< the look under way is a glance, which nobody has ordered
  DriftMonitor drift_;
  PoseHistory poses_;
  std::map<int, LandmarkModel> models_;
  std::deque<LookOrder> orders_;
  bool following_ = false;                ///< the front of orders_ was ordered by nobody
  bool beyond_ = false;                   ///< and is a look at what stands beyond its landmark
  std::optional<HeadSetting> beyond_at_;  ///< where the head stands for looks beyond the landmark
  std::optional<LookOrder> looked_at_;    ///< for which the head stands as it does; none: for something else
  PictureSource pictures_;
  bool lost_ = false;  ///< a picture of the present look is lost to the log
  std::optional<HeadReport> report_;
  std::unique_ptr<VideoLink> video_;  ///< none in lockstep and on a log

  bus::Latest<head_state_t> head_state_;
  bus::Inbox<camera_frame_t> frames_;
  bus::Inbox<pose_t> pose_;
  bus::Inbox<landmark_model_t> landmark_models_;
  bus::Inbox<look_request_t> look_requests_;
  bus::Inbox<head_drive_t> wishes_;
  bus::Inbox<head_aim_t> aims_;
  bus::Publisher<head_command_t> head_command_;
  bus::Publisher<camera_trigger_t> trigger_;
  bus::Publisher<landmark_fix_t> fix_;
  bus::Publisher<door_seen_t> door_seen_;
  bus::Publisher<landmark_view_t> view_;
};

}  // namespace priamos::head
