#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/app_host.hpp"
#include "bus/clocks/clock.hpp"
#include "bus/clocks/log_time.hpp"
#include "bus/real_time_loop.hpp"

namespace priamos::bus {

/// Runs an App on a log that somebody plays onto a bus, as lcm-logplayer does: `--clock bus`. Its time is
/// that of the newest message, whatever the speed of the player; the App ticks at the moments it would have
/// ticked, and where its own messages are in the log, at theirs. When the log is played again, the App begins
/// anew.
///
/// It claims no role and commands nobody: what it sends goes to channels of the prefix kPrefix.
class LogFollower {
 public:
  static constexpr std::string_view kPrefix = "REPLAYED_";

  /// Makes the App when the first message with a time stamp has come.
  using Starter = std::function<std::unique_ptr<AppHost>(const Clock&)>;

  /// Subscribes on `bus` before anybody else; `name` is that of the process. `first` are messages that it
  /// hears before those of the bus. `bus` and `schema` must outlive it.
  LogFollower(LcmBus& bus, const Schema& schema, std::string name, Starter start,
              std::vector<HeardMessage> first = {});
  /// Takes back every subscription of the bus.
  ~LogFollower();
  LogFollower(const LogFollower&) = delete;
  LogFollower& operator=(const LogFollower&) = delete;

  /// Runs until a signal or RequestStop and returns the exit code; nullopt when the log went back: another
  /// follower begins anew, with what this one heard of the log that began again. When the bus falls silent,
  /// `warn` is given what was not followed.
  std::optional<int> Run(const SignalWatch& signals,
                         const std::function<void(const std::string&)>& warn = {});
  /// What was heard of the log that began again.
  std::vector<HeardMessage> TakeBeginning() { return beginning_.Take(); }
  /// What was heard of late and is not followed, as a sentence for people; empty: nothing.
  std::string NotFollowed() const;

 private:
  void Hear(std::string_view channel, std::span<const std::byte> bytes);
  void Begin();
  std::string Problems() const;
  bool IsOwn(std::string_view channel, std::span<const std::byte> bytes) const;
  void TickUntil(Time until, bool including);

  LcmBus& bus_;
  const Schema& schema_;
  std::string name_;
  Starter start_;
  LogTime time_;
  std::vector<HeardMessage> first_;  ///< until the App is made
  BeginningAgain beginning_;
  std::uint64_t heard_ = 0;  ///< messages, of whatever kind
  SimulatedClock clock_{Time{}};
  std::unique_ptr<AppHost> host_;
};

}  // namespace priamos::bus
