#include "cli/verbs/deployment/up_queries.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "bus/wire/bus_address.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/supervise/supervisor_search.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "cli/verbs/deployment/process_call.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr auto kDownWithin = std::chrono::seconds(15);

struct QueryOptions {
  std::string log_root;
  std::string robot{bus::kDefaultRobot};
  std::string network;
  std::string process;  ///< `logs`: empty: all
  BusOptions bus;       ///< `logs`: where a process is asked for that is not up here
  std::size_t lines = 20;
  bool json = false;
};

int SayDown(bool was_up, bool json) {
  if (json) {
    std::cout << ordered_json{{"was_up", was_up}, {"up", false}} << "\n";
    return 0;
  }
  std::cout << (was_up ? "everything is down\n" : "nothing is up\n");
  return 0;
}

/// Says where the robot is up if it is up from another folder of logs; returns false if it is not.
bool SayWhereItIsUp(const QueryOptions& options) {
  const auto found = FindSupervisor(options.robot, options.network);
  if (!found) return false;
  std::cerr << Describe(*found, options.robot) << "\n";
  if (options.json)
    std::cout << ordered_json{{"up", false},
                              {"elsewhere", found->who},
                              {"logs", found->log_root ? ordered_json(*found->log_root) : ordered_json()}}
              << "\n";
  return true;
}

int Down(const QueryOptions& options) {
  const auto pid = UpLock::Holder(options.log_root);
  if (!pid) return SayWhereItIsUp(options) ? kNotThere : SayDown(false, options.json);
  kill(*pid, SIGTERM);
  const auto give_up = std::chrono::steady_clock::now() + kDownWithin;
  while (UpLock::Holder(options.log_root) == pid) {
    if (std::chrono::steady_clock::now() > give_up) {
      std::cerr << fmt::format(
          "priamos down: pid {} did not end within 15 s; `kill -9 {}` ends it and its processes\n", *pid,
          *pid);
      return kNotThere;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return SayDown(true, options.json);
}

int Status(const QueryOptions& options) {
  const auto state = ReadUpState(options.log_root);
  if (!UpLock::Holder(options.log_root) || !state) {
    if (SayWhereItIsUp(options)) return kNotThere;
    std::cout << (options.json ? "{\"up\":false}\n" : "nothing is up\n");
    return kNotThere;
  }
  ordered_json all{{"up", true}};
  if (options.json) all.update(ToJson(*state));
  std::cout << (options.json ? all.dump() + "\n" : FormatUpState(*state, TableSize()));
  return state->ready ? 0 : kNotThere;
}

/// The last `lines` of a console.
std::vector<std::string> Tail(const fs::path& file, std::size_t lines) {
  std::ifstream in(file);
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) all.push_back(line);
  if (all.size() > lines) all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(lines));
  return all;
}

void Print(const std::string& process, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::cout << fmt::format("{:<18} {}\n", process, line);
}

void PrintJson(const ordered_json& all) {
  std::cout << all.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << "\n";
}

/// Of a process that is not up from here: it is asked for on the bus, and through the radio.
int LogsOfBus(const QueryOptions& options) {
  ProcessCall call("priamos logs", options.bus);
  const auto lines = call.Lines(options.process, options.lines);
  if (!lines) throw std::runtime_error(call.NobodyAnswers(options.process));
  if (options.json) PrintJson(ordered_json::array({{{"process", options.process}, {"lines", *lines}}}));
  if (!options.json) Print(options.process, *lines);
  return 0;
}

/// Whether processes of the side of `name`, onboard or offboard, are up from here; then it is one of them.
bool HasSideOf(const std::string& name, const std::optional<UpState>& state) {
  const std::string side = name.substr(0, name.find('-') + 1);
  if (!state || (side != "onboard-" && side != "offboard-")) return state.has_value();
  return std::any_of(state->processes.begin(), state->processes.end(),
                     [&](const ProcessReport& p) { return p.name.starts_with(side); });
}

int Logs(const QueryOptions& options) {
  const std::string& name = options.process;
  const auto state = ReadUpState(options.log_root);
  if (!name.empty() && !HasSideOf(name, state)) return LogsOfBus(options);
  if (!state) {
    std::cout << (options.json ? "[]\n" : "nothing was ever up\n");
    return kNotThere;
  }
  auto all = ordered_json::array();
  std::vector<std::string> known;
  for (const ProcessReport& p : state->processes) {
    known.push_back(p.name);
    if (!name.empty() && p.name != name) continue;
    const auto tail = Tail(fs::path(state->folder) / (p.name + ".txt"), options.lines);
    all.push_back({{"process", p.name}, {"lines", tail}});
    if (!options.json) Print(p.name, tail);
  }
  if (all.empty() && !name.empty())
    throw std::runtime_error(
        fmt::format("unknown process \"{}\"{} (priamos status lists all)", name, NearestText(name, known)));
  if (options.json) PrintJson(all);
  return 0;
}

void AddRobot(CLI::App& verb, QueryOptions& options) {
  verb.add_option("--robot", options.robot, "whom to look for on the buses when nothing is up from --logs")
      ->envname(bus::kRobotVariable)
      ->capture_default_str();
  verb.add_option("--network", options.network, "interface or its address, by which to look for it")
      ->envname(bus::kNetworkVariable);
}

void AddShared(CLI::App& verb, QueryOptions& options) {
  AddUpLogsOption(verb, options.log_root);
  verb.add_flag("--json", options.json, "machine-readable");
}

}  // namespace

void AddUpLogsOption(CLI::App& verb, std::string& log_root) {
  AddLogsOption(verb, log_root, "consoles and state, one `up` per folder");
  verb.parse_complete_callback([&log_root] { log_root = LogRoot(log_root); });
}

void Show(const UpState& state, bool json) {
  std::cout << (json ? ToJson(state).dump() + "\n" : FormatUpState(state, TableSize()));
}

void AddUpQueries(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<QueryOptions>();
  auto* down = AddVerb(cli, "down", "End what `priamos up` started, in order.");
  down->footer("Example: priamos down");
  AddShared(*down, *options);
  AddRobot(*down, *options);
  down->callback([options, &exit_code] { exit_code = Down(*options); });

  auto* status =
      AddVerb(cli, "status", "What is up, how it is, and why it last ended; exit code 0 when all is ready.");
  status->footer("Example: priamos status --json");
  AddShared(*status, *options);
  AddRobot(*status, *options);
  status->callback([options, &exit_code] { exit_code = Status(*options); });

  auto* logs = AddVerb(cli, "logs", "The consoles of the processes, also of one behind the radio.");
  logs->footer("Example: priamos logs onboard-robot -n 50");
  logs->add_option("process", options->process, "one process; without it all");
  logs->add_option("-n", options->lines, "lines per process")->capture_default_str();
  AddShared(*logs, *options);
  AddBusOption(*logs, options->bus);
  logs->callback([options, &exit_code] { exit_code = Logs(*options); });
}

}  // namespace priamos::cli
