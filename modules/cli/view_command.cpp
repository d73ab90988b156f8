#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "bus/own_types.hpp"
#include "cli/bus_options.hpp"
#include "cli/bus_watch.hpp"
#include "cli/commands.hpp"
#include "cli/view_screen.hpp"

namespace priamos::cli {
namespace {

struct ViewOptions {
  BusOptions bus;
  bool once = false;
  double seconds = 0;  ///< end after so long; 0: at Ctrl-C
};

ScreenSize SizeOfTerminal() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20 || size.ws_row < 10) return {};
  return {size.ws_col, size.ws_row};
}

/// 0; 1 when nothing was seen in the time given.
int RunView(const ViewOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const bus::MonotonicClock clock;
  bus::LcmBus bus(options.bus.bus.Url());
  bus::Node node(bus, schema, clock);
  auto views = node.SubscribeAll(channels::kLandmarkView);
  auto fixes = node.SubscribeAll(channels::kLandmarkFix);
  auto lines = node.SubscribeAll(channels::kObstacleLine);
  LinkListener listener(
      node, {std::string(channels::kLandmarkView.name), std::string(channels::kObstacleLine.name)});
  ViewScreen screen;
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  const Time until = options.seconds > 0 ? clock.Now() + FromSeconds(options.seconds) : Time::max();
  Time next = clock.Now();
  Watch(
      bus, clock, until, [&] { return options.once && !screen.empty(); },
      [&] {
        listener.Step(clock.Now());
        for (const landmark_fix_t& fix : fixes.Drain()) screen.Add(fix);
        for (const landmark_view_t& view : views.Drain()) screen.Add(view);
        for (const obstacle_line_t& line : lines.Drain()) screen.Add(line);
        if (options.once || clock.Now() < next) return;
        next = clock.Now() + FromSeconds(0.3);
        std::cout << "\x1b[H\x1b[2J" << screen.Render(clock.Now(), SizeOfTerminal(), true) << std::flush;
      });
  if (options.once) std::cout << screen.Render(clock.Now(), SizeOfTerminal(), terminal);
  return screen.empty() ? 1 : 0;
}

}  // namespace

void AddViewCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  auto* verb = cli.add_subcommand(
      "view",
      "What the head sees, as lines in the terminal: also over the radio, which sends it while this runs.");
  verb->footer("Example: priamos view --once --for 60");
  verb->add_flag("--once", options->once, "print what comes first and end");
  verb->add_option("--for", options->seconds, "s; 0: until Ctrl-C")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  AddBusOption(*verb, options->bus);
  verb->callback([options, &exit_code] { exit_code = RunView(*options); });
}

}  // namespace priamos::cli
