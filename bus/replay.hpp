#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/app_host.hpp"
#include "bus/log/log_reader.hpp"
#include "common/config.hpp"

namespace priamos::bus {

/// One message an App sent, live or replayed.
struct Output {
  std::int64_t utime = 0;
  std::string channel;
  std::vector<std::byte> bytes;
};

/// Runs one App from a log instead of a bus. Time is the log's: the App ticks at the moments it would have
/// ticked, and gets the recorded messages in between, in their order.
///
/// The clock begins with the App's own first HEALTH in the log, which it sends in its first tick, or with
/// the first event when there is none. What the App itself sent is not fed to it, but shows when it had
/// ticked: a message recorded at the very moment of a tick counts as heard before it, unless one of the
/// App's own messages of that moment comes first. With a log from lockstep this is exact to the byte; a
/// log of a live bus has the recorder's times, so ticks are off by up to a period.
class Replay {
 public:
  /// What the recorded process started from: folder of its configuration, seed, where its log goes.
  struct Options {
    std::string config_dir = ".";
    std::uint64_t seed = 0;
    std::function<void(Level, std::string_view)> log{};  ///< none: silent
  };

  /// Replay of one App from the log `log_path`, which is read twice. Throws what the reader and the App's
  /// start throw.
  Replay(const AppFactory& factory, const ConfigSource& source, const Schema& schema,
         const std::string& log_path, const Options& options);
  ~Replay();

  /// Feeds the whole log; `send` gets what the App sends. An App that asks to stop ends it.
  void Run(const std::function<void(const Output&)>& send);

  /// Messages in the log that the App sent when it was recorded, from the start of the clock on.
  const std::vector<Output>& recorded() const { return recorded_; }
  std::uint64_t fed() const { return fed_; }
  /// Number of events left out because of an impossible time.
  std::uint64_t implausible() const { return implausible_; }
  /// What was heard, `sent` and left out, as a sentence for people.
  std::string Summary(std::uint64_t sent) const;
  std::uint64_t skipped_bytes() const { return reader_.skipped_bytes(); }
  const Node& node() const { return host_->node(); }

 private:
  bool IsOwn(const LogEvent& event) const;
  void TickUntil(Time until, bool including);
  void Feed(const LogEvent& event);

  std::string name_;
  const Schema& schema_;
  LogReader reader_;
  SimulatedClock clock_;
  LcmBus bus_;
  std::unique_ptr<AppHost> host_;
  std::function<void(const Output&)> send_;
  bool feeding_ = false;
  std::uint64_t fed_ = 0, implausible_ = 0;
  std::vector<Output> recorded_;
};

}  // namespace priamos::bus
