#include "robot/message_codes.hpp"

namespace priamos::robot {

std::optional<Driver> DriverOf(int code) {
  switch (code) {
    case lease_request_t::NOBODY:
      return Driver::kNobody;
    case lease_request_t::PLANNER:
      return Driver::kPlanner;
    case lease_request_t::CONSOLE:
      return Driver::kConsole;
    case lease_request_t::TELEOP:
      return Driver::kTeleop;
    default:
      return std::nullopt;
  }
}

std::int8_t DriverCode(Driver driver) {
  switch (driver) {
    case Driver::kNobody:
      break;
    case Driver::kPlanner:
      return lease_request_t::PLANNER;
    case Driver::kConsole:
      return lease_request_t::CONSOLE;
    case Driver::kTeleop:
      return lease_request_t::TELEOP;
  }
  return lease_request_t::NOBODY;
}

std::optional<Lease::Wish> WishOf(int code) {
  switch (code) {
    case lease_request_t::ACQUIRE:
      return Lease::Wish::kAcquire;
    case lease_request_t::TAKE_OVER:
      return Lease::Wish::kTakeOver;
    case lease_request_t::RELEASE:
      return Lease::Wish::kRelease;
    default:
      return std::nullopt;
  }
}

std::int8_t RefusalCode(CommandVerdict verdict) {
  switch (verdict) {
    case CommandVerdict::kAccepted:
      break;
    case CommandVerdict::kWithoutLease:
      return drive_status_t::REFUSED_WITHOUT_LEASE;
    case CommandVerdict::kOutOfOrder:
      return drive_status_t::REFUSED_OUT_OF_ORDER;
    case CommandVerdict::kTooOld:
      return drive_status_t::REFUSED_TOO_OLD;
    case CommandVerdict::kOutOfRange:
      return drive_status_t::REFUSED_OUT_OF_RANGE;
    case CommandVerdict::kNotAtRest:
      return drive_status_t::REFUSED_NOT_AT_REST;
  }
  return drive_status_t::REFUSED_NOTHING;
}

std::int8_t ModeCode(DriveMode mode) {
  switch (mode) {
    case DriveMode::kIdle:
      return drive_status_t::IDLE;
    case DriveMode::kFollowing:
      return drive_status_t::FOLLOWING;
    case DriveMode::kArrived:
      return drive_status_t::ARRIVED;
    case DriveMode::kHolding:
      return drive_status_t::HOLDING;
    case DriveMode::kBlocked:
      return drive_status_t::BLOCKED;
    case DriveMode::kOperated:
      return drive_status_t::OPERATED;
  }
  return drive_status_t::IDLE;
}

std::int8_t LimitCode(Condition condition) {
  switch (condition) {
    case Condition::kEstop:
      return drive_status_t::LIMIT_ESTOP;
    case Condition::kTouched:
    case Condition::kBumped:  // the mode tells them apart: a base that was bumped keeps its path
      return drive_status_t::LIMIT_TOUCHED;
    case Condition::kBumperSilent:
      return drive_status_t::LIMIT_BUMPER_SILENT;
    case Condition::kLeaseLost:
      return drive_status_t::LIMIT_LEASE_LOST;
    case Condition::kOperatorSilent:
      return drive_status_t::LIMIT_OPERATOR_SILENT;
    case Condition::kWheelsSilent:
      return drive_status_t::LIMIT_WHEELS_SILENT;
    case Condition::kWheelsStuck:
      return drive_status_t::LIMIT_WHEELS_STUCK;
    case Condition::kSonarSilent:
      return drive_status_t::LIMIT_SONAR_SILENT;
    case Condition::kPoseLost:
      return drive_status_t::LIMIT_POSE_STALE;
    case Condition::kHeadSilent:
      return drive_status_t::LIMIT_HEAD_SILENT;
    case Condition::kLinkLost:
      return drive_status_t::LIMIT_LINK_LOST;
  }
  return drive_status_t::LIMIT_NONE;
}

std::int8_t VerdictCode(FixVerdict verdict) {
  switch (verdict) {
    case FixVerdict::kApplied:
      return pose_correction_t::APPLIED;
    case FixVerdict::kTooOld:
    case FixVerdict::kTooNew:
      return pose_correction_t::TOO_OLD;
    case FixVerdict::kImplausible:
    case FixVerdict::kDouble:
      break;
  }
  return pose_correction_t::IMPLAUSIBLE;
}

}  // namespace priamos::robot
