#include <fmt/format.h>
#include <poll.h>

#include <CLI/App.hpp>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/clocks/clock_exchange.hpp"
#include "bus/clocks/clock_health.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/health_text.hpp"
#include "bus/log/log_recorder.hpp"
#include "bus/log/log_selection.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/real_time_loop.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/log/commands.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kIncomplete = 1;
constexpr double kMost = 1e9;  ///< MB, minutes, seconds: more than any machine has
constexpr auto kHealthPeriod = std::chrono::seconds(1);

struct RecordOptions {
  BusOptions bus;
  std::string file;
  std::vector<std::string> only, without;
  double split_mb = 0, split_minutes = 0, keep_free_mb = 100, seconds = 0;
  std::size_t keep = 0;
  bool no_health = false, json = false;
};

std::string DefaultFile() {
  const std::filesystem::path folder = LogRoot("");
  std::filesystem::create_directories(folder);
  return folder / (NameByTime() + ".lcmlog");
}

bus::RecorderLimits LimitsOf(const RecordOptions& options) {
  return {static_cast<std::uint64_t>(options.split_mb * 1e6), FromSeconds(60 * options.split_minutes),
          options.keep, static_cast<std::uint64_t>(options.keep_free_mb * 1e6)};
}

/// A recording of one bus, with its sign of life on that bus.
class Recording {
 public:
  explicit Recording(const RecordOptions& options)
      : options_(options),
        schema_(bus::OwnTypes()),
        types_(options.bus.types.empty() ? bus::OwnTypes() : LoadTypes(options.bus.types)),
        bus_(options.bus.bus.Url(), options.bus.messages()),
        clocks_(options.bus.bus.IsNamed() ? bus::ExchangeWhereNeeded(bus_, schema_, clock_) : nullptr),
        node_(bus_, schema_, clock_),
        health_(node_.Advertise(channels::kHealth)),
        recorder_(options.file, LimitsOf(options), clock_.Now()),
        start_(clock_.Now()) {
    recorder_.DefineTypesOf(types_);
    wanted_.only = options.only;
    wanted_.without = options.without;
    bus_.SubscribeEverything([this](std::string_view channel, std::span<const std::byte> bytes) {
      const Time now = clock_.Now();
      if (wanted_.Wants(ToUtime(now), channel)) recorder_.Add(now, channel, bytes);
    });
  }

  int Run() {
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is a failed write, not the end
    if (!options_.json) std::cout << recorder_.file().string() << std::endl;
    const auto end = options_.seconds > 0 ? start_ + FromSeconds(options_.seconds) : Time::max();
    do {
      pollfd fds[] = {{bus_.fd(), POLLIN, 0}, {signals_.fd(), POLLIN, 0}};
      poll(fds, std::size(fds), 50);
      if (fds[1].revents != 0) break;
      bus_.Drain();
      if (clocks_) clocks_->Tick(clock_.Now());
      recorder_.Tick(clock_.Now());
      ReportAlarm();
      SendHealth();
    } while (clock_.Now() < end);
    bus_.Drain();  // what came in the last round
    return End();
  }

 private:
  void ReportAlarm() {
    if (recorder_.alarm() == reported_) return;
    reported_ = recorder_.alarm();
    if (reported_.empty()) {
      std::cerr << "recording again: " << recorder_.file().string() << std::endl;
    } else {
      std::cerr << "ALARM: " << reported_ << std::endl;
    }
    next_health_ = {};
  }

  /// The alarm goes where an operator looks: on the bus, at once.
  void SendHealth() {
    const Time now = clock_.Now();
    if (options_.no_health || now < next_health_) return;
    next_health_ = now + kHealthPeriod;
    health_t message{};
    message.utime = ToUtime(now);
    message.process = "recorder";
    message.state = reported_.empty() ? health_t::OK : health_t::FAILED;
    message.messages_lost =
        static_cast<std::int32_t>(std::min<std::uint64_t>(bus_.lost() + recorder_.lost(), 1'000'000));
    bus::SetClock(message, clocks_ ? clocks_->AheadOfReference(now) : bus::ClockDifference{});
    message.text = bus::FitHealthText(reported_);
    health_.Publish(message);
  }

  int End() {
    recorder_.Tick(clock_.Now() + std::chrono::seconds(1));
    if (options_.json) {
      std::cout << nlohmann::ordered_json{{"events", recorder_.recorded()},
                                          {"bytes", recorder_.bytes()},
                                          {"lost_network", bus_.lost()},
                                          {"lost_disk", recorder_.lost() - recorder_.unwritable()},
                                          {"unwritable", recorder_.unwritable()},
                                          {"alarm", recorder_.alarm()}}
                << "\n";
      return Code();
    }
    const auto unwritable = recorder_.unwritable();
    std::cout << fmt::format(
        "{}, {}; lost: {} on the network, {} on the disk{}\n", Counted(recorder_.recorded(), "event"),
        Counted(recorder_.bytes(), "byte"), bus_.lost(), recorder_.lost() - unwritable,
        unwritable > 0 ? fmt::format(", {} that no log can hold (name, time or size)", unwritable) : "");
    return Code();
  }
  int Code() const { return recorder_.alarm().empty() && recorder_.lost() == 0 ? 0 : kIncomplete; }

  RecordOptions options_;
  bus::SignalWatch signals_;
  bus::HostClock clock_;
  bus::Schema schema_, types_;  ///< of what it says itself; of what it records
  bus::LcmBus bus_;
  /// Of a robot of several computers the log has stamps of one clock.
  std::unique_ptr<bus::ClockExchange> clocks_;
  bus::Node node_;
  bus::Publisher<health_t> health_;
  bus::LogRecorder recorder_;
  bus::LogSelection wanted_;
  Time start_, next_health_{};
  std::string reported_;
};

void AddFileLimits(CLI::App& verb, RecordOptions& options) {
  verb.add_option("--split-mb", options.split_mb, "begin another file (.1, .2 ...) after so many megabytes")
      ->check(CLI::Range(0.0, kMost));
  verb.add_option("--split-minutes", options.split_minutes, "... or after so many minutes")
      ->check(CLI::Range(0.0, kMost));
  verb.add_option("--keep", options.keep, "keep the newest so many files of this recording; 0: all");
  verb.add_option("--keep-free-mb", options.keep_free_mb,
                  "stop before less of the disk is free (with --keep the oldest files go first)")
      ->capture_default_str()
      ->check(CLI::Range(0.0, kMost));
}

}  // namespace

void AddLogRecordVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<RecordOptions>();
  auto* verb = AddVerb(log, "record", "Record a bus, until Ctrl-C.");
  verb->footer(
      "The log defines the types of its messages: it can be read when they have changed.\n"
      "A full or read-only disk is reported on the terminal and as HEALTH of \"recorder\" within a second; "
      "the file ends with\nits last whole event, and recording goes on when there is room again.\n"
      "Example: priamos log record logs/day.lcmlog --split-mb 100 --keep 20");
  verb->add_option("file", options->file,
                   "log to write; none: <time>.lcmlog in ~/.local/state/priamos, or logs of a clone");
  AddBusOption(*verb, options->bus);
  AddTypesOption(*verb, options->bus.types);
  verb->add_option("--channels", options->only, "only these, A,B or with a star: 'WHEEL_*'")->delimiter(',');
  verb->add_option("--without", options->without, "not these")->delimiter(',');
  AddFileLimits(*verb, *options);
  verb->add_option("--seconds", options->seconds, "stop after so long; 0: at Ctrl-C")
      ->check(CLI::Range(0.0, kMost));
  verb->add_flag("--no-health", options->no_health, "send nothing on the bus");
  verb->add_flag("--json", options->json, "the count at the end machine-readable");
  verb->callback([options, &exit_code] {
    if (options->file == "-")
      throw std::runtime_error(
          "expected the name of a new log, got \"-\": a log cannot go to standard output");
    if (options->file.empty()) options->file = DefaultFile();
    if (std::filesystem::exists(options->file))
      throw std::runtime_error(options->file + ": expected a new file, got an existing one");
    exit_code = Recording(*options).Run();
  });
}

}  // namespace priamos::cli
