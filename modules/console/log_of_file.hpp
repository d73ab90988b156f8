#pragma once

#include "bus/log/log_player.hpp"
#include "console/shown_log.hpp"

namespace priamos::console {

/// A log file that the station plays itself: pages pause it, step, seek and change its speed.
class LogOfFile : public ShownLog {
 public:
  explicit LogOfFile(bus::LogPlayer log) : log_(std::move(log)) {}

  void Play(Time now, LogListener& listener) override;
  void Obey(const ReplayOrder& order, Time now, LogListener& listener) override;
  Time time() const override { return log_.begin() + log_.position(); }
  nlohmann::ordered_json State() const override;

 private:
  /// Plays what is due, so many events at most.
  void Play(Time now, LogListener& listener, int at_most);
  void Seek(Duration position, Time now, LogListener& listener);

  bus::LogPlayer log_;
};

}  // namespace priamos::console
