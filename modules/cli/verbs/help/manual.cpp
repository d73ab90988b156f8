#include "cli/verbs/help/manual.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bus/process_options.hpp"
#include "bus/radio/link_config.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/supervise/deployment.hpp"
#include "common/config_keys.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {
namespace {

std::vector<const CLI::App*> VisibleVerbs(const CLI::App& app) {
  auto verbs = app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
  return verbs;
}

/// Options and arguments of a verb as a line, e.g. `[OPTION...] log [out]`.
std::string Usage(const CLI::App& app) {
  std::string usage = "[OPTION...]";
  for (const auto* option : app.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    usage += option->get_required() ? " " + name : " [" + name + "]";
  }
  return usage;
}

void AddOptions(ManualPage& page, const CLI::App& app) {
  const CLI::Formatter as_in_help;
  for (const auto* option : app.get_options()) {
    if (option->get_group().empty() || option == app.get_help_ptr()) continue;
    page.Term(option->get_name(option->get_positional(), true), as_in_help.make_option_opts(option),
              option->get_description());
  }
}

/// The footer of a verb is its example.
void AddExample(ManualPage& page, const CLI::App& app) {
  if (!app.get_footer().empty()) page.Example(app.get_footer());
}

void AddExitStatus(ManualPage& page, const std::string& one) {
  page.Section("EXIT STATUS");
  page.Term("0", "", "Done.");
  page.Term("1", "", one);
  page.Term("2", "",
            "It could not begin: one sentence on standard error names the word, or file, line and key, and "
            "what was "
            "expected.");
}

/// A verb, and the verbs of that verb.
void AddVerb(ManualPage& page, const CLI::App& app, const std::string& name) {
  page.Subsection(fmt::format("{} {}", name, Usage(app)));
  page.Paragraph(app.get_description());
  AddOptions(page, app);
  AddExample(page, app);
}

ManualPage VerbPage(const CLI::App& verb, const ManualIssue& issue) {
  const std::string name = "priamos " + verb.get_name();
  ManualPage page("priamos-" + verb.get_name(), 1, verb.get_description(), issue);
  const auto inner = VisibleVerbs(verb);
  page.Section("SYNOPSIS");
  if (inner.empty()) page.Paragraph(name + " " + Usage(verb));
  std::string usages;
  for (const auto* sub : inner) usages += fmt::format("{} {} {}\n", name, sub->get_name(), Usage(*sub));
  if (!inner.empty()) page.Example(usages);
  page.Section("DESCRIPTION");
  page.Paragraph(verb.get_description());
  for (const auto* sub : inner) AddVerb(page, *sub, name + " " + sub->get_name());
  if (inner.empty()) {
    page.Section("OPTIONS");
    AddOptions(page, verb);
    page.Term("-h, --help", "", "Print this in short.");
  }
  if (!verb.get_footer().empty()) page.Section("EXAMPLES");
  AddExample(page, verb);
  AddExitStatus(page, "A run that did not succeed, or something that is not there.");
  page.SeeAlso({"priamos(1)"});
  return page;
}

const std::vector<std::string> kModules{"console", "head", "planner", "radio", "robot", "teleop", "world"};

void AddPlaces(ManualPage& page) {
  page.Section("ENVIRONMENT");
  page.Term("PRIAMOS_DATA", "", "A folder with config/ inside that is looked into before all others.");
  page.Term(
      "XDG_CONFIG_HOME, XDG_CONFIG_DIRS", "",
      "A deployment of the user or of the machine in priamos/NAME there goes before the installed one.");
  page.Term("PRIAMOS_LOGS", "", "A folder that runs are written to.");
  page.Term("XDG_STATE_HOME", "",
            "Runs are written to priamos/ there, without it to ~/.local/state/priamos.");
  page.Term("PRIAMOS_BUS, PRIAMOS_ROBOT, PRIAMOS_TTL, PRIAMOS_NETWORK", "",
            "Defaults of --bus, --robot, --ttl and --network.");
  page.Term(
      "PRIAMOS_RUNTIME", "",
      "The folder in which the processes of this computer agree on their clock, in place of /run/priamos and "
      "/tmp/priamos-UID.");
  page.Section("FILES");
  page.Term("share/priamos/config/NAME", "",
            "The installed deployments, below the folder of the installation.");
  page.Term(
      "etc/priamos/robot", "",
      "The deployment of this robot; /etc/priamos/robot when the programs are in /usr/bin. What is there is "
      "never overwritten.");
  page.Term("share/priamos/lcmtypes", "", "The message types.");
}

ManualPage MainPage(const CLI::App& cli, const ManualIssue& issue) {
  ManualPage page("priamos", 1, cli.get_description(), issue);
  page.Section("SYNOPSIS");
  page.Paragraph("priamos VERB [OPTION...]");
  page.Section("DESCRIPTION");
  page.Paragraph("One command with a verb for everything that is not a process of the robot.");
  std::vector<std::string> pages;
  for (const auto* verb : VisibleVerbs(cli)) {
    page.Term(verb->get_name(), "", verb->get_description());
    pages.push_back(fmt::format("priamos-{}(1)", verb->get_name()));
  }
  page.Paragraph("Every verb answers --help.");
  AddPlaces(page);
  AddExitStatus(page, "A run that did not succeed.");
  for (const auto& module : kModules) pages.push_back(fmt::format("priamos-{}(1)", module));
  for (const char* file : {"deployment", "scenario", "link", "map"})
    pages.push_back(fmt::format("priamos-{}(5)", file));
  page.SeeAlso(pages);
  return page;
}

void AddKeys(ManualPage& page, const std::vector<ConfigKey>& keys) {
  for (const auto& key : keys) page.Term(key.name, key.value.empty() ? "" : " = " + key.value, key.meaning);
}

ManualPage ProcessPage(const std::string& module, const ManualIssue& issue) {
  const auto factory = FactoryFor(module);
  bus::ProcessOptions options;
  CLI::App cli(factory.summary, "priamos-" + module);
  bus::AddProcessOptions(cli, factory, options);
  ManualPage page("priamos-" + module, 1, factory.summary, issue);
  page.Section("SYNOPSIS");
  page.Paragraph(fmt::format("priamos-{} {}", module, Usage(cli)));
  page.Section("DESCRIPTION");
  page.Paragraph(factory.summary);
  page.Paragraph(
      "It runs until SIGINT or SIGTERM, reports READY=1 and WATCHDOG=1 to the process that started it "
      "(sd_notify), and sends HEALTH on its bus.");
  page.Section("OPTIONS");
  AddOptions(page, cli);
  page.Section("CONFIGURATION");
  page.Paragraph(
      "The keys of the TOML file behind --config, each with its default. One that is left out keeps it.");
  AddKeys(page, ConfigKeysOf(module));
  AddExitStatus(page, "An error while it ran.");
  page.SeeAlso({"priamos(1)", "priamos-deployment(5)"});
  return page;
}

ManualPage FilePage(const std::string& name, const std::string& summary, const std::string& text,
                    const std::vector<ConfigKey>& keys, const ManualIssue& issue) {
  ManualPage page("priamos-" + name, 5, summary, issue);
  page.Section("DESCRIPTION");
  page.Paragraph(text);
  page.Section("KEYS");
  AddKeys(page, keys);
  page.SeeAlso({"priamos(1)"});
  return page;
}

}  // namespace

std::vector<ManualPage> Manual(const CLI::App& cli, const ManualIssue& issue) {
  std::vector<ManualPage> pages{MainPage(cli, issue)};
  for (const auto* verb : VisibleVerbs(cli)) pages.push_back(VerbPage(*verb, issue));
  for (const auto& module : kModules) pages.push_back(ProcessPage(module, issue));
  pages.push_back(
      FilePage("deployment", "deployment.toml, the processes of a robot",
               "TOML. The file that priamos up reads: which processes run, on which bus, after which.",
               KeysOf<Deployment>(), issue));
  pages.push_back(FilePage("scenario", "scenarios/NAME.toml, what runs and what happens",
                           "TOML. The file that priamos run and priamos lockstep read.", KeysOf<Scenario>(),
                           issue));
  pages.push_back(
      FilePage("link", "link.toml, what crosses the radio",
               "TOML. The file that both ends of the radio read: which channels cross, which way and how "
               "often. priamos link budget shows whether the line can carry it.",
               KeysOf<bus::radio::LinkConfig>(), issue));
  pages.push_back(FilePage("map", "maps/NAME.toml, the plan of a building",
                           "TOML. The file that the planner reads: walls, and doors as landmarks.",
                           KeysOf<GroundPlan>(), issue));
  return pages;
}

}  // namespace priamos::cli
