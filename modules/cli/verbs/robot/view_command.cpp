#include <CLI/App.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/bus_watch.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "cli/terminal/view_screen.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr Duration kPeriod{300'000};

struct ViewOptions {
  BusOptions bus;
  bool once = false;
  bool json = false;
  double seconds = 0;  ///< end after so long; 0: at Ctrl-C
};

/// A line per message, with its channel.
class JsonLines {
 public:
  explicit JsonLines(const bus::Schema& schema) : schema_(schema) {}
  template <class T>
  void Print(const Channel<T>& channel, const T& message) const {
    const auto* type = schema_.Find(static_cast<std::uint64_t>(T::getHash()));
    std::cout
        << bus::Json{{"channel", channel.name}, {"message", bus::ToJson(*type, bus::Encode(message))}}.dump()
        << std::endl;
  }

 private:
  const bus::Schema& schema_;
};

/// 0; 1 when nothing was seen in the time given.
int RunView(const ViewOptions& options) {
  BusSession session("priamos view", options.bus, channels::kLandmarkView.name);
  auto views = session.node().SubscribeAll(channels::kLandmarkView);
  auto fixes = session.node().SubscribeAll(channels::kLandmarkFix);
  auto lines = session.node().SubscribeAll(channels::kObstacleLine);
  LinkListener listener(
      session.node(), {std::string(channels::kLandmarkView.name), std::string(channels::kObstacleLine.name)});
  ViewScreen screen;
  const JsonLines lines_of_json(session.schema());
  const auto take = [&](const auto& channel, auto& inbox) {
    for (const auto& message : inbox.Drain()) {
      session.Heard();
      screen.Add(message);
      if (options.json) lines_of_json.Print(channel, message);
    }
  };
  TerminalScreen terminal;
  const Time until = options.seconds > 0 ? session.now() + FromSeconds(options.seconds) : Time::max();
  session.Watch(
      until, [&] { return options.once && !screen.empty(); },
      [&] {
        listener.Step(session.now());
        take(channels::kLandmarkFix, fixes);
        take(channels::kLandmarkView, views);
        take(channels::kObstacleLine, lines);
        if (options.once || options.json || screen.empty() || !terminal.Due(session.now(), kPeriod)) return;
        terminal.Show(
            screen.Render(session.now(), terminal.size().value_or(ScreenSize{}), terminal.is_terminal()));
      });
  if (options.once && !options.json)
    std::cout << screen.Render(session.now(), terminal.size().value_or(ScreenSize{}), terminal.is_terminal());
  return screen.empty() ? 1 : 0;
}

}  // namespace

void AddViewCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  auto* verb = AddVerb(
      cli, "view",
      "What the head sees, as lines in the terminal: also over the radio, which sends it while this runs.");
  verb->footer("Example: priamos view --once --for 60");
  verb->add_flag("--once", options->once, "print what comes first and end");
  verb->add_option("--for", options->seconds, "s; 0: until Ctrl-C")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  verb->add_flag("--json", options->json, "a line per message instead of a screen");
  AddBusOption(*verb, options->bus);
  verb->callback([options, &exit_code] { exit_code = RunView(*options); });
}

}  // namespace priamos::cli
