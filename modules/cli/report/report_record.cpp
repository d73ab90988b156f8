#include "cli/report/report_record.hpp"

#include <cmath>
#include <exception>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/walk.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

/// A pose that is not a number would pass every check of form, and ruin every figure.
template <class T>
bool IsFinite(const T& message) {
  if constexpr (requires { message.x_m + message.y_m + message.yaw_rad; })
    return std::isfinite(message.x_m) && std::isfinite(message.y_m) && std::isfinite(message.yaw_rad);
  return true;
}

}  // namespace

RunRecord::RunRecord() : schema_(std::make_shared<const bus::Schema>(bus::OwnTypes())) {}

template <class T>
void RunRecord::Append(std::vector<T>& stream, std::span<const std::byte> bytes) {
  const auto fingerprint = static_cast<std::uint64_t>(T::getHash());
  const auto* type = schema_->Find(fingerprint);
  if (!type || !bus::Walk(*type, bytes)) {
    ++refused;
    return;
  }
  try {
    T message = bus::Decode<T>(bytes);
    if (IsFinite(message)) return stream.push_back(std::move(message));
  } catch (const std::exception&) {
    // Counted below, like every other message that is none.
  }
  ++refused;
}

void RunRecord::Add(Side side, std::int64_t utime, std::string_view channel,
                    std::span<const std::byte> bytes) {
  if (channel == channels::kAlarm.name) return Append(alarms, bytes);  // it crosses no radio
  side == Side::kOnboard ? AddOnboard(channel, bytes) : AddOffboard(utime, channel, bytes);
}

void RunRecord::AddOnboard(std::string_view channel, std::span<const std::byte> bytes) {
  if (channel == channels::kWorldTruth.name) Append(truth, bytes);
  if (channel == channels::kWorldTouch.name) Append(touches, bytes);
  if (channel == channels::kPose.name) Append(poses, bytes);
  if (channel == channels::kPoseCorrection.name) Append(corrections, bytes);
  if (channel == channels::kLandmarkFix.name) Append(fixes, bytes);
  if (channel == channels::kLandmarkView.name) Append(views, bytes);
  if (channel == channels::kDriveStatus.name) Append(drive, bytes);
  if (channel == channels::kDriveCommand.name) Append(commands, bytes);
  if (channel == channels::kLinkStatus.name) Append(onboard_link, bytes);
}

void RunRecord::AddOffboard(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes) {
  if (channel == channels::kLookRequest.name) Append(looks, bytes);
  if (channel == channels::kMissionCommand.name) Append(orders, bytes);
  if (channel == channels::kMissionStatus.name) Append(mission, bytes);
  if (channel == channels::kFeatures.name) Append(features, bytes);
  if (channel == channels::kDoorFound.name) Append(doors, bytes);
  if (channel == channels::kSceneObject.name) Append(objects, bytes);
  if (channel == channels::kAlarmAck.name) Append(acks, bytes);
  if (channel == channels::kFloorMap.name) AddMap(bytes);
  if (channel == channels::kLinkStatus.name) Append(offboard_link, bytes);
  if (channel != channels::kPose.name) return;
  std::vector<pose_t> received;
  Append(received, bytes);
  for (const pose_t& pose : received) pose_ages_s.push_back(Seconds(Duration(utime - pose.utime)));
}

/// The parts of one map have the same revision.
void RunRecord::AddMap(std::span<const std::byte> bytes) {
  std::vector<floor_map_t> parts;
  Append(parts, bytes);
  for (floor_map_t& part : parts) {
    if (!map.empty() && map.front().revision != part.revision) map.clear();
    map.push_back(std::move(part));
  }
}

}  // namespace priamos::cli
