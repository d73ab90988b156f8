#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <memory>

#include "cli/options/verb_setup.hpp"
#include "cli/supervise/supervisor_desk.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/deployment/commands.hpp"
#include "cli/verbs/deployment/process_call.hpp"

namespace priamos::cli {
namespace {

constexpr int kNotDone = 1;

struct RestartOptions {
  BusOptions bus;
  std::string process;
  bool json = false;
};

int Report(const RestartOptions& options, bool done, const std::string& text) {
  if (options.json) std::cout << JsonLine({{"done", done}, {"text", text}}) << "\n";
  if (!done) std::cerr << "priamos restart: " << text << "\n";
  if (done && !options.json) std::cout << text << "\n";
  return done ? 0 : kNotDone;
}

int Restart(const RestartOptions& options) {
  ProcessCall call("priamos restart", options.bus);
  const std::string& name = options.process;
  const Time ordered = call.now();
  const auto answer = call.Ask(process_order_t::RESTART, name);
  if (!answer) {
    call.Hear(name);
    return Report(options, false, call.NobodyAnswers(name));
  }
  if (answer->outcome != process_report_t::DONE)
    return Report(options, false, std::string(OutcomeOfProcess(answer->outcome)));
  // The answer says when it was given; its way, which may be a radio's, does not count.
  const bool known_ready = FromUtime(answer->utime) - ordered < SupervisorDesk::kReadyWithin;
  if (!known_ready && !call.WaitUntilReady(name))
    return Report(options, false,
                  fmt::format("{} does not run again within 30 s; next: priamos logs {}", name, name));
  return Report(options, true,
                fmt::format("{} runs again after {:.1f} s", name, Seconds(call.now() - ordered)));
}

}  // namespace

void AddRestartCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<RestartOptions>();
  auto* restart = AddVerb(cli, "restart",
                          "Start a process again that `priamos up` supervises, also behind the radio; the "
                          "base stands before its own is (exit code 1: not done).");
  restart->footer("Example: priamos restart onboard-head");
  restart->add_option("process", options->process, "its name, as `priamos status` has it")->required();
  AddBusOption(*restart, options->bus);
  CompleteVerb(*restart, options, Restart, exit_code);
}

}  // namespace priamos::cli
