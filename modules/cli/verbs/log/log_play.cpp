#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/clocks/host_clock.hpp"
#include "bus/log/log_player.hpp"
#include "bus/log/type_texts.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/schema/schema.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/play_keyboard.hpp"
#include "cli/terminal/play_keys.hpp"
#include "cli/verbs/log/commands.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kNotAllSent = 1;
constexpr auto kShowPeriod = std::chrono::milliseconds(200);

struct PlayOptions {
  BusOptions bus;
  SelectionOptions selection;
  std::string log;
  std::string speed = "1";
  bool loop = false, paused = false, json = false;
};

/// A foreign log may have channels of those names.
template <class T>
bool IsOf(const Channel<T>& channel, const bus::LogEvent& event) {
  return event.channel == channel.name && bus::FingerprintOf(event.bytes.data(), event.bytes.size()) ==
                                              static_cast<std::uint64_t>(T::getHash());
}

class Playing {
 public:
  explicit Playing(const PlayOptions& options)
      : json_(options.json),
        bus_(options.bus.bus.Url(), options.bus.messages()),
        player_(bus::LogReader(options.log), SelectionOf(options.selection, options.log)) {
    if (player_.events() == 0)
      throw std::runtime_error(fmt::format("{}: expected events to play, got none; next: priamos log info {}",
                                           options.log, options.log));
    const Time now = clock_.Now();
    player_.SetSpeed(ParseSpeed(options.speed), now);
    player_.SetLoop(options.loop);
    player_.Pause(options.paused, now);
  }

  int Run() {
    while (!player_.done() && !quit_) {
      Wait();
      const int sent = player_.Play(
          clock_.Now(),
          [this](const std::string& channel, const bus::LogEvent& event) {
            // Claims belong to processes, and those of the log do not run; nor does anybody ask its
            // questions.
            if (IsOf(channels::kClaim, event) || IsOf(channels::kProbe, event)) return;
            if (bus::IsTypeText(event.bytes)) return;  // it is the log's, and was on no bus
            if (!bus_.Fits(event.bytes.size())) ++too_long_;
            ++(bus_.Publish(channel, event.bytes) ? sent_ : refused_);
          },
          kBurst);
      // Flat out, a receiver's socket buffer needs a moment between bursts.
      if (player_.speed() == bus::LogPlayer::kFlatOut && sent == kBurst) usleep(1000);
      Show();
    }
    status_.Wipe();
    if (json_)
      std::cout << nlohmann::ordered_json{{"sent", sent_},
                                          {"refused", refused_},
                                          {"skipped_bytes", player_.skipped_bytes()}}
                << "\n";
    else
      std::cout << fmt::format("{} sent, {} refused, {} skipped\n", Counted(sent_, "event"), refused_,
                               Counted(player_.skipped_bytes(), "damaged byte"));
    if (too_long_ > 0)
      std::cerr << fmt::format("{} longer than an unfragmented message; --fragments sends them\n", too_long_);
    if (refused_ > too_long_)
      std::cerr << fmt::format("{} not taken by the network; next: priamos doctor\n", refused_ - too_long_);
    return refused_ > 0 ? kNotAllSent : 0;
  }

 private:
  static constexpr int kBurst = 50;

  void Wait() {
    const Time due = player_.NextDue(), now = clock_.Now();
    const auto wait = due <= now ? Duration() : std::min(due == Time::max() ? kLongest : due - now, kLongest);
    pollfd fds[] = {{signals_.fd(), POLLIN, 0}, {keyboard_.fd(), POLLIN, 0}};
    const timespec time{0, static_cast<long>(wait.count() * 1000)};
    ppoll(fds, std::size(fds), &time, nullptr);
    if (fds[0].revents != 0) quit_ = true;
    if (fds[1].revents != 0 && !ApplyKeys(keyboard_.Read(), player_, clock_.Now())) quit_ = true;
  }

  void Show() {
    const Time now = clock_.Now();
    if (now < next_show_) return;
    next_show_ = now + kShowPeriod;
    keyboard_.Keep();
    status_.Show(fmt::format("{:.2f} of {:.2f} s, {}x{}{}", Seconds(player_.position()),
                             Seconds(player_.length()), SpeedText(player_.speed()),
                             player_.paused() ? ", paused" : "",
                             keyboard_.fd() < 0 ? "" : fmt::format("   {}", kPlayKeysInShort)));
  }

  static constexpr Duration kLongest = std::chrono::milliseconds(100);
  bool json_;
  bus::SignalWatch signals_;
  bus::HostClock clock_;
  bus::LcmBus bus_;
  bus::LogPlayer player_;
  StatusLine status_;
  PlayKeyboard keyboard_;
  Time next_show_{};
  std::uint64_t sent_ = 0, refused_ = 0, too_long_ = 0;
  bool quit_ = false;
};

}  // namespace

void AddLogPlayVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<PlayOptions>();
  auto* verb = AddVerb(log, "play", "Play a log onto a bus.");
  verb->footer(
      std::string(kPlayKeysHelp) +
      "\nExample: priamos log play onboard.lcmlog --speed 1/4 --without 'WHEEL_*' --rename POSE=POSE_OLD");
  verb->add_option("log", options->log, "LCM log")->required()->check(CLI::ExistingFile);
  AddBusOption(*verb, options->bus);
  verb->add_option("--speed", options->speed, "1/64 to 1000, or max")->capture_default_str();
  verb->add_flag("--loop", options->loop, "begin again at the end");
  verb->add_flag("--paused", options->paused, "wait for a key");
  verb->add_flag("--json", options->json, "the count at the end machine-readable");
  AddSelectionOptions(*verb, options->selection);
  verb->callback([options, &exit_code] { exit_code = Playing(*options).Run(); });
}

}  // namespace priamos::cli
