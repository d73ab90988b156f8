#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/options/bus_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/help/commands.hpp"
#include "cli/verbs/help/doctor.hpp"

namespace priamos::cli {
namespace {

constexpr int kIll = 1;

std::string Word(Finding::Verdict verdict) {
  switch (verdict) {
    case Finding::Verdict::kGood:
      return "good";
    case Finding::Verdict::kNotNeededYet:
      return "note";
    case Finding::Verdict::kBad:
      return "BAD";
  }
  return "?";
}

void Print(const std::vector<Finding>& findings, bool json) {
  auto all = nlohmann::ordered_json::array();
  for (const auto& f : findings) {
    all.push_back(
        {{"what", f.what}, {"verdict", Word(f.verdict)}, {"found", f.found}, {"command", f.command}});
    if (json) continue;
    std::cout << fmt::format("{:<5} {:<22} {}\n", Word(f.verdict), f.what, f.found);
    if (!f.command.empty()) std::cout << fmt::format("{:<28} {}\n", "", f.command);
  }
  if (json) std::cout << all.dump() << "\n";
}

}  // namespace

void AddDoctorCommand(CLI::App& cli, int& exit_code) {
  struct Options : BusOptions {
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = AddVerb(
      cli, "doctor",
      "What this machine lacks, each with the command that mends it (exit code 1 when something is bad).");
  verb->footer("Example: priamos doctor --bus onboard --ttl 1");
  bus::AddBusChoice(*verb, options->bus);
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code] {
    const auto findings = Examine(ThisMachine(), options->bus.Url());
    Print(findings, options->json);
    exit_code = std::any_of(findings.begin(), findings.end(),
                            [](const Finding& f) { return f.verdict == Finding::Verdict::kBad; })
                    ? kIll
                    : 0;
  });
}

}  // namespace priamos::cli
