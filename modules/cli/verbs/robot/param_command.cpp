#include <fmt/format.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "bus/parameters/parameter_messages.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "common/pilot/repeated_order.hpp"
#include "common/text/nearest_word.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kNotDone = 1;

struct ParamOptions {
  BusOptions bus;
  std::string deployment = "sim", process, key;
  double value = 0;
  bool json = false;
};

bus::ParameterSheet SheetOf(const ParamOptions& options, const std::string& module) {
  const fs::path file = fs::path(FolderOfDeployment(options.deployment)) / (module + ".toml");
  return FactoryFor(module).parameters({file.string(), {}});
}

ParameterTable TableOf(const std::string& module) {
  return FactoryFor(module).parameters({}).table;
}

/// The number of the key; throws ConfigError that says what is near, or when the key would take effect.
int NumberOf(const ParameterTable& table, const ParamOptions& options) {
  if (const int number = table.NumberOf(options.key)) return number;
  std::vector<std::string> live, all;
  for (const Parameter& parameter : table.all()) live.push_back(parameter.name);
  for (const ConfigKey& key : ConfigKeysOf(options.process))
    if (key.name == options.key)
      throw ConfigError(
          fmt::format("{}: expected a key that may be changed while {} runs, got one that takes effect at "
                      "its next start; "
                      "next: write it into {}.toml, or priamos param list {}",
                      options.key, options.process, options.process, options.process));
  throw ConfigError(fmt::format("key: expected one of `priamos param list {}`, got \"{}\"{}", options.process,
                                options.key, NearestText(options.key, live)));
}

/// Asks one process, one order after the other.
class Questioner {
 public:
  explicit Questioner(const ParamOptions& options, const std::string& who)
      : session_("priamos param " + who, options.bus, channels::kParameterValue.name),
        table_(TableOf(options.process)),
        process_(*bus::ParameterProcess(options.process)),
        answers_(session_.node().SubscribeAll(channels::kParameterValue)),
        orders_(session_.node().Advertise(channels::kParameterOrder)) {}

  const ParameterTable& table() const { return table_; }

  /// The process's answer; nullopt when none came in time.
  std::optional<parameter_value_t> Ask(std::int8_t action, int key = 0, double value = 0) {
    RepeatedOrder<parameter_order_t> order;
    std::optional<parameter_value_t> answer;
    order.Give(bus::ToMessage({process_, action, key, value}, table_, session_.now()), session_.now());
    session_.Watch(
        Time::max(), [&] { return !order.open(); },
        [&] {
          for (const parameter_value_t& message : answers_.Drain()) {
            if (message.process != process_ || !order.Answered(message.request_id)) continue;
            session_.Heard();
            answer = message;
          }
          if (const auto again = order.Step(session_.now())) orders_.Publish(*again);
        });
    return answer;
  }

 private:
  BusSession session_;
  ParameterTable table_;
  std::int8_t process_;
  bus::Inbox<parameter_value_t> answers_;
  bus::Publisher<parameter_order_t> orders_;
};

/// Prints what became of an order; the exit code.
int Report(const ParamOptions& options, const std::string& verb, const std::string& done,
           const std::optional<parameter_value_t>& answer, const ParameterTable& table) {
  const bool obeyed = answer && answer->outcome == parameter_value_t::DONE;
  const Parameter* parameter = answer ? table.Find(answer->key) : nullptr;
  std::string text = !answer  ? fmt::format("no answer from {}; next: priamos link top", options.process)
                     : obeyed ? done
                              : std::string(bus::OutcomeText(answer->outcome));
  if (parameter != nullptr && answer->outcome != parameter_value_t::OTHER_TABLE)
    text += fmt::format("; in force: {} = {} {}", parameter->name, bus::RoundedParameter(answer->value),
                        parameter->unit);
  if (options.json) {
    std::cout << JsonLine({{"done", obeyed},
                           {"text", text},
                           {"value", parameter ? JsonScalar(bus::RoundedParameter(answer->value))
                                               : JsonScalar(nullptr)},
                           {"unsaved", answer && answer->unsaved != 0}})
              << "\n";
  } else if (obeyed) {
    std::cout << text << (answer->unsaved ? " (not saved)" : "") << "\n";
  }
  if (!obeyed) std::cerr << "priamos param " << verb << ": " << text << "\n";
  return obeyed ? 0 : kNotDone;
}

int List(const ParamOptions& options) {
  const auto modules = options.process.empty() ? ModulesWithParameters() : std::vector{options.process};
  for (const std::string& module : modules) {
    const bus::ParameterSheet sheet = SheetOf(options, module);
    for (std::size_t i = 0; i < sheet.values.size(); ++i) {
      const Parameter& p = sheet.table.all()[i];
      if (options.json)
        std::cout << JsonLine({{"process", module},
                               {"key", p.name},
                               {"value", sheet.values[i]},
                               {"unit", p.unit},
                               {"min", p.min},
                               {"max", p.max},
                               {"change", std::string(LiveText(p.change))},
                               {"meaning", p.meaning}})
                  << "\n";
      else
        std::cout << fmt::format("{:<8} {:<54} {:>6} {:<8} {} to {}; {}; {}\n", module, p.name,
                                 sheet.values[i], p.unit, p.min, p.max, p.meaning, LiveText(p.change));
    }
  }
  return 0;
}

/// Without a key: what differs from the file of the process, one after the other.
int GetAll(const ParamOptions& options) {
  Questioner questioner(options, "get");
  std::optional<parameter_value_t> answer = questioner.Ask(parameter_order_t::READ);
  const auto good = [&] { return answer && answer->outcome == parameter_value_t::DONE; };
  const bool any = good() && answer->next_changed != 0;
  while (good() && answer->next_changed != 0) {
    answer = questioner.Ask(parameter_order_t::READ, answer->next_changed);
    if (good()) Report(options, "get", "differs from the file", answer, questioner.table());
  }
  if (good() && any) return 0;
  return Report(options, "get", "all as in the file of the process", answer, questioner.table());
}

int Get(const ParamOptions& options) {
  if (options.key.empty()) return GetAll(options);
  const int number = NumberOf(TableOf(options.process), options);
  Questioner questioner(options, "get");
  return Report(options, "get", "read", questioner.Ask(parameter_order_t::READ, number), questioner.table());
}

int Set(const ParamOptions& options) {
  const ParameterTable table = TableOf(options.process);
  const int number = NumberOf(table, options);
  const Parameter& parameter = *table.Find(number);
  if (!(options.value >= parameter.min && options.value <= parameter.max))
    throw ConfigError(fmt::format("value: expected {} to {} [{}], got {}", parameter.min, parameter.max,
                                  parameter.unit, options.value));
  Questioner questioner(options, "set");
  return Report(options, "set", "changed", questioner.Ask(parameter_order_t::SET, number, options.value),
                questioner.table());
}

int Save(const ParamOptions& options) {
  Questioner questioner(options, "save");
  return Report(options, "save", "saved: the next start takes them, too",
                questioner.Ask(parameter_order_t::SAVE), questioner.table());
}

int Reset(const ParamOptions& options) {
  Questioner questioner(options, "reset");
  return Report(options, "reset", "as in the file of the process again, and nothing is saved",
                questioner.Ask(parameter_order_t::RESET), questioner.table());
}

/// The options that the verbs share; `options` are the verb's own.
CLI::App* AddPart(CLI::App& param, const char* name, const char* what, const char* example,
                  ParamOptions& options, bool on_bus) {
  auto* verb = AddVerb(param, name, what);
  verb->footer(example);
  auto* process = verb->add_option("process", options.process, "robot, head or planner")
                      ->check(CLI::IsMember(ModulesWithParameters()));
  if (on_bus) {
    process->required();
    AddBusOption(*verb, options.bus);
  } else {
    AddDeploymentOption(*verb, options.deployment);
  }
  return verb;
}

}  // namespace

void AddParamCommand(CLI::App& cli, int& exit_code) {
  auto* param =
      AddVerb(cli, "param",
              "Parameters of a running process: what may be changed, what is in force; change, save "
              "and reset (exit code 1: not done).");
  param->footer("Example: priamos param set robot drive.follower.shape.max_speed_m_s 0.3");
  param->require_subcommand(1);
  const auto add = [&](const char* name, const char* what, const char* example,
                       int (*run)(const ParamOptions&), bool on_bus) {
    auto options = std::make_shared<ParamOptions>();
    auto* verb = AddPart(*param, name, what, example, *options, on_bus);
    if (run == Get || run == Set) {
      auto* key = verb->add_option("key", options->key, "its name, as `priamos param list` prints it");
      if (run == Set) {
        key->required();
        verb->add_option("value", options->value, "in the unit of the key")->required();
      }
    }
    CompleteVerb(*verb, options, run, exit_code);
  };
  add("list", "What may be changed while the process runs: value in the file, unit, range, meaning.",
      "Example: priamos param list robot", List, false);
  add("get", "What is in force: of a key, or of all that differ from the file.",
      "Example: priamos param get robot", Get, true);
  add("set", "Change a key at once, until the process ends or `save`.",
      "Example: priamos param set robot drive.follower.shape.max_speed_m_s 0.3", Set, true);
  add("save", "Have the next start take what differs from the file, too.",
      "Example: priamos param save robot", Save, true);
  add("reset", "Put the values of the file in force again, and forget what was saved.",
      "Example: priamos param reset robot", Reset, true);
}

}  // namespace priamos::cli
