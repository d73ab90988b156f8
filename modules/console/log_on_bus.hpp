#pragma once

#include <optional>

#include "bus/clocks/log_time.hpp"
#include "console/shown_log.hpp"

namespace priamos::bus {
class LcmBus;
class Schema;
}  // namespace priamos::bus

namespace priamos::console {

/// A log that somebody else plays onto a bus, at whatever speed: LCM's player, or `priamos log play`. Its
/// time is that of the newest message; pages cannot steer it.
class LogOnBus : public ShownLog {
 public:
  /// Both must outlive it. What is on channels of those who run on the same log (LogFollower::kPrefix) is not
  /// the log's.
  LogOnBus(bus::LcmBus& bus, const bus::Schema& schema);

  void Play(Time now, LogListener& listener) override;
  void Obey(const ReplayOrder&, Time, LogListener&) override {}
  Time time() const override { return log_time_.now().value_or(Time{}); }
  nlohmann::ordered_json State() const override;

 private:
  void Hear(std::string_view channel, std::span<const std::byte> bytes);
  void BeginAgain();
  void MeasureSpeed(Time now);

  bus::LcmBus& bus_;
  const bus::Schema& schema_;
  bus::LogTime log_time_;
  bus::BeginningAgain beginning_;
  std::optional<Time> begin_;  ///< of the log, as far as it was heard
  LogListener* listener_ = nullptr;
  double speed_ = 0;
  Time measured_{}, log_measured_{};
};

}  // namespace priamos::console
