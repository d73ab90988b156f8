#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <memory>

#include "cli/options/verb_setup.hpp"
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
  if (!call.Hear(options.process)) return Report(options, false, call.NobodyAnswers(options.process));
  const int starts = call.StartsOf(options.process);
  const auto answer = call.Ask(process_order_t::RESTART, options.process);
  if (!answer) return Report(options, false, call.NobodyAnswers(options.process));
  if (answer->outcome != process_report_t::DONE)
    return Report(options, false, std::string(OutcomeOfProcess(answer->outcome)));
  const auto waited_s = call.WaitUntilReady(options.process, starts);
  if (!waited_s)
    return Report(options, false, fmt::format("{} does not run again within 30 s", options.process));
  return Report(options, true, fmt::format("{} runs again after {:.1f} s", options.process, *waited_s));
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
