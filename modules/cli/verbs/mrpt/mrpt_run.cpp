#include "cli/verbs/mrpt/mrpt_run.hpp"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "bus/wire/typed_message.hpp"
#include "common/geometry.hpp"
#include "common/sonar_ring.hpp"
#include "common/time.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

/// Between two places of a simplemap.
constexpr double kApart_m = 0.10, kApart_deg = 5;
constexpr double kBeam_deg = 15;

mrpt::Clock::time_point TimeOf(std::int64_t utime) {
  return mrpt::Clock::fromDouble(static_cast<double>(utime) * 1e-6);
}

mrpt::obs::CObservationOdometry::Ptr ToMrpt(const odometry_t& message) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = TimeOf(message.utime);
  odometry->sensorLabel = channels::kOdometry.name;
  odometry->odometry = {message.x_m, message.y_m, message.yaw_rad};
  odometry->hasVelocities = true;
  odometry->velocityLocal = {message.vx_m_s, message.vy_m_s, message.wz_rad_s};
  return odometry;
}

/// Sensors without an echo are left out.
mrpt::obs::CObservationRange::Ptr ToMrpt(const sonar_ranges_t& message, const Eigen::Vector2d& footprint_m) {
  auto ranges = mrpt::obs::CObservationRange::Create();
  ranges->timestamp = TimeOf(message.utime);
  ranges->sensorLabel = channels::kSonarRanges.name;
  ranges->minSensorDistance = static_cast<float>(kSonarMin_m);
  ranges->maxSensorDistance = static_cast<float>(kSonarMax_m);
  ranges->sensorConeApperture = static_cast<float>(Radians(kBeam_deg));
  for (int i = 0; i < kSonars; ++i) {
    if (!(message.range_m[i] >= 0 && message.range_m[i] <= kSonarMax_m)) continue;
    const Pose2 at = BaseFromSonar(i, footprint_m);
    mrpt::obs::CObservationRange::TMeasurement echo;
    echo.sensorID = static_cast<std::uint16_t>(i + 1);
    echo.sensorPose = mrpt::math::TPose3D(at.x, at.y, 0, at.yaw, 0, 0);
    echo.sensedDistance = static_cast<float>(message.range_m[i]);
    ranges->sensedData.push_back(echo);
  }
  return ranges;
}

mrpt::poses::CPose3DPDFGaussian::Ptr ToMrpt(const pose_t& message) {
  mrpt::poses::CPosePDFGaussian flat;
  flat.mean = {message.x_m, message.y_m, message.yaw_rad};
  const double x = message.sigma_x_m, y = message.sigma_y_m, yaw = message.sigma_yaw_rad;
  flat.cov(0, 0) = x * x;
  flat.cov(1, 1) = y * y;
  flat.cov(2, 2) = yaw * yaw;
  flat.cov(0, 1) = flat.cov(1, 0) = message.rho_x_y * x * y;
  flat.cov(0, 2) = flat.cov(2, 0) = message.rho_x_yaw * x * yaw;
  flat.cov(1, 2) = flat.cov(2, 1) = message.rho_y_yaw * y * yaw;
  auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
  pose->copyFrom(flat);
  return pose;
}

bool IsFinite(const odometry_t& m) {
  return std::isfinite(m.x_m + m.y_m + m.yaw_rad + m.vx_m_s + m.vy_m_s + m.wz_rad_s);
}
bool IsFinite(const pose_t& m) {
  return std::isfinite(m.x_m + m.y_m + m.yaw_rad + m.sigma_x_m + m.sigma_y_m + m.sigma_yaw_rad + m.rho_x_y +
                       m.rho_x_yaw + m.rho_y_yaw);
}
bool IsFinite(const sonar_ranges_t& /*message*/) {
  return true;  // what is no range is no echo
}

/// Decodes the events of one channel; what cannot be decoded is counted.
template <class T, class Take>
void Visit(const bus::LogEvent& event, const Channel<T>& channel, MrptCount& count, const Take& take) {
  if (event.channel != channel.name) return;
  try {
    const T message = bus::Decode<T>(event.bytes);
    if (IsFinite(message)) return take(message);
  } catch (const std::runtime_error&) {
    // Counted below, like a message with numbers that are none.
  }
  ++count.refused;
}

bool IsApart(const Pose2& from, const Pose2& to) {
  const Pose2 moved = from.Inverse() * to;
  return moved.translation().norm() >= kApart_m || std::abs(moved.yaw) >= Radians(kApart_deg);
}

[[noreturn]] void FailToWrite(const std::string& file) {
  throw std::runtime_error(file + ": cannot be written: is the disk full?");
}

}  // namespace

MrptCount WriteRawlog(bus::LogReader& log, const bus::LogSelection& selection,
                      const Eigen::Vector2d& footprint_m, const std::string& file) {
  MrptCount count;
  mrpt::obs::CRawlog rawlog;
  while (const auto event = log.Next()) {
    if (!selection.Wants(event->utime, event->channel)) continue;
    Visit(*event, channels::kOdometry, count, [&](const odometry_t& message) {
      rawlog.insert(ToMrpt(message));
      ++count.places;
    });
    Visit(*event, channels::kSonarRanges, count, [&](const sonar_ranges_t& message) {
      rawlog.insert(ToMrpt(message, footprint_m));
      ++count.cycles;
    });
  }
  if (!rawlog.saveToRawLogFile(file)) FailToWrite(file);
  return count;
}

MrptCount WriteSimplemap(bus::LogReader& log, const bus::LogSelection& selection,
                         const Eigen::Vector2d& footprint_m, const std::string& file) {
  MrptCount count;
  mrpt::maps::CSimpleMap map;
  std::optional<pose_t> pose;
  std::optional<Pose2> last;
  while (const auto event = log.Next()) {
    if (!selection.Wants(event->utime, event->channel)) continue;
    Visit(*event, channels::kPose, count, [&](const pose_t& message) { pose = message; });
    Visit(*event, channels::kSonarRanges, count, [&](const sonar_ranges_t& message) {
      if (!pose) return;
      const Pose2 here{pose->x_m, pose->y_m, pose->yaw_rad};
      if (last && !IsApart(*last, here)) return;
      auto frame = mrpt::obs::CSensoryFrame::Create();
      frame->insert(ToMrpt(message, footprint_m));
      map.insert(ToMrpt(*pose), frame);
      last = here;
      ++count.cycles;
      ++count.places;
    });
  }
  if (!map.saveToFile(file)) FailToWrite(file);
  return count;
}

}  // namespace priamos::cli
