#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "bus/wire/bus_error.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/supervise/deployment.hpp"
#include "cli/verbs/help/commands.hpp"
#include "cli/verbs/help/doctor.hpp"
#include "cli/verbs/help/probe_bus.hpp"
#include "common/config.hpp"

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

struct DoctorOptions {
  bus::BusChoice bus;
  std::string deployment;
  std::vector<std::string> expected;
  double seconds = 2;
  bool probe = false, json = false;
};

/// The bus that is meant, and whether other hosts are to be on it.
struct ExaminedBus {
  std::string url;
  bool other_hosts = false;
};

ExaminedBus BusOf(const DoctorOptions& options) {
  const bool expects = !options.expected.empty();
  if (options.deployment.empty()) return {options.bus.Url(), expects};
  const std::filesystem::path folder = FolderOfDeployment(options.deployment);
  auto deployment = LoadConfig<Deployment>((folder / "deployment.toml").string());
  std::string& network =
      options.bus.bus == "onboard" ? deployment.onboard_network : deployment.offboard_network;
  if (network.empty()) network = options.bus.network;
  std::set<std::string> hosts;
  for (const ScenarioProcess& process : deployment.processes)
    if (process.bus == options.bus.bus) hosts.insert(process.host);
  if (options.bus.bus == "onboard") return {deployment.OnboardUrl(), expects || hosts.size() > 1};
  if (options.bus.bus == "offboard") return {deployment.OffboardUrl(), expects || hosts.size() > 1};
  throw bus::BusError(
      fmt::format("--bus: expected onboard or offboard with --deployment, got \"{}\"", options.bus.bus));
}

/// What the other hosts answer; a bus that cannot be joined is one more thing to mend.
std::vector<Finding> Ways(const DoctorOptions& options, const std::string& url) {
  RequireHosts(url);
  try {
    return ProbeBus(url, options.seconds).Findings(options.expected);
  } catch (const bus::BusError& error) {
    return {{"bus", Finding::Verdict::kBad, error.what(), ""}};
  }
}

int RunDoctor(const DoctorOptions& options) {
  const ExaminedBus examined = BusOf(options);
  auto findings = Examine(ThisMachine(), examined.url, examined.other_hosts);
  const bool no_way = findings.front().verdict == Finding::Verdict::kBad;
  if ((options.probe || !options.expected.empty()) && !no_way) {
    const auto ways = Ways(options, examined.url);
    findings.insert(findings.end(), ways.begin(), ways.end());
  }
  Print(findings, options.json);
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.verdict == Finding::Verdict::kBad; })
             ? kIll
             : 0;
}

}  // namespace

void AddDoctorCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  auto* verb = AddVerb(
      cli, "doctor",
      "What this machine lacks, each with the command that mends it (exit code 1 when something is bad).");
  verb->footer("Example: priamos doctor --bus onboard --ttl 1 --probe");
  bus::AddBusChoice(*verb, options->bus);
  verb->add_option("--deployment", options->deployment,
                   "take robot, ttl and network from this deployment (sim, robot, or a folder with a slash)");
  verb->add_flag("--probe", options->probe,
                 "ask the other hosts of the bus for an answer, and tell which way between them is cut");
  verb->add_option("--expect", options->expected,
                   "--probe, and a host of this name has to be there; may be given again")
      ->allow_extra_args(false);
  verb->add_option("--seconds", options->seconds, "how long to ask [s]")
      ->check(CLI::Range(0.5, 600.0))
      ->capture_default_str();
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code] { exit_code = RunDoctor(*options); });
}

}  // namespace priamos::cli
