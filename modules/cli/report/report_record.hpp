#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bus/schema/schema.hpp"
#include "common/geometry.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// Which bus a message was recorded on.
enum class Side { kOnboard, kOffboard };

/// Of the base's middle in the world, when it was told.
inline Pose2 PoseOf(const world_truth_t& truth) {
  return {truth.x_m, truth.y_m, truth.yaw_rad};
}

/// The messages of one run: the decoded messages that a report is made of, each stream in the order of
/// recording. It is fed message by message, from a live bus, from lockstep or from logs; what the report does
/// not need is ignored, what is not a valid message is counted.
class RunRecord {
 public:
  RunRecord();

  /// Adds a message of one bus. `utime` is the time of recording [us].
  void Add(Side side, std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes);

  // Onboard.
  std::vector<world_truth_t> truth;
  std::vector<world_touch_t> touches;
  std::vector<pose_t> poses;
  std::vector<pose_correction_t> corrections;
  std::vector<landmark_fix_t> fixes;
  std::vector<landmark_view_t> views;
  std::vector<drive_status_t> drive;
  std::vector<drive_command_t> commands;  ///< an operator's wishes
  // Offboard: requests and status of the planner.
  std::vector<look_request_t> looks;
  std::vector<mission_command_t> orders;
  std::vector<mission_status_t> mission;
  std::vector<features_t> features;     ///< walls as they came to the workstation
  std::vector<door_found_t> doors;      ///< doors likewise
  std::vector<scene_object_t> objects;  ///< and things
  std::vector<alarm_ack_t> acks;
  std::vector<floor_map_t> map;  ///< the planner's map, in the parts of the newest one
  /// Age of each pose when it came to the workstation [s]: what the radio costs in time.
  std::vector<double> pose_ages_s;
  std::vector<alarm_t> alarms;  ///< of the processes of both buses
  // Each end of the radio about itself.
  std::vector<link_status_t> onboard_link, offboard_link;

  /// Messages on these channels that were damaged, of the wrong type, or not numbers.
  std::uint64_t refused = 0;

 private:
  template <class T>
  void Append(std::vector<T>& stream, std::span<const std::byte> bytes);
  void AddMap(std::span<const std::byte> bytes);
  void AddOnboard(std::string_view channel, std::span<const std::byte> bytes);
  void AddOffboard(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes);

  std::shared_ptr<const bus::Schema> schema_;
};

}  // namespace priamos::cli
