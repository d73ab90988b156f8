#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/world/commands.hpp"
#include "cli/verbs/world/generated_files.hpp"
#include "common/config_printer.hpp"

namespace priamos::cli {
namespace {

struct GenerateOptions {
  std::string kind = "room", into, deployment = "sim";
  std::uint64_t seed = 1;
  bool there_and_back = false, follow = false, explore = false, force = false, json = false;
};

/// Somebody may have changed what was generated.
void RefuseToReplaceWorld(const GenerateOptions& options) {
  const auto world =
      std::filesystem::path(options.into) / fmt::format("worlds/{}-{}.toml", options.kind, options.seed);
  if (!options.force && std::filesystem::exists(world))
    throw ConfigError(
        fmt::format("{}: expected a new world, got one that is there; --force replaces it", world.string()));
}

int RunGenerate(const GenerateOptions& options) {
  RefuseToReplaceWorld(options);
  const auto generated = world::Generate(options.kind, options.seed);
  const auto task = options.explore          ? GeneratedTask::kExplore
                    : options.follow         ? GeneratedTask::kCorridor
                    : options.there_and_back ? GeneratedTask::kThereAndBack
                                             : GeneratedTask::kDoor;
  const auto files = WriteGenerated(generated, options.kind, options.seed, task,
                                    FolderOfDeployment(options.deployment), options.into);
  const std::string next =
      fmt::format("priamos lockstep --deployment {}/ --scenario {} --seed 1", options.into, files.scenario);
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"folder", options.into},  {"scenario", files.scenario},
                                        {"world", files.world},    {"map", files.map},
                                        {"true_map", files.truth}, {"next", next}}
                     .dump()
              << std::endl;
    return 0;
  }
  std::cout << fmt::format("{}: world {}, map {}, scenario {}\nnext: {}\n", options.into, files.world,
                           files.map, files.scenario, next)
            << std::flush;
  return 0;
}

/// One of everything that a world file may list.
world::WorldPlan OneOfEach() {
  world::WorldPlan plan;
  plan.surfaces.emplace_back();
  plan.doors.emplace_back().swings.emplace_back();
  plan.posters.emplace_back();
  plan.boxes.emplace_back();
  plan.strewn.emplace_back();
  plan.free_lanes.emplace_back();
  plan.people.emplace_back().waypoints.emplace_back();
  plan.holes.emplace_back();
  plan.faults.sonars.emplace_back();
  plan.faults.motors.emplace_back();
  return plan;
}

void AddGenerate(CLI::App& world, int& exit_code) {
  auto options = std::make_shared<GenerateOptions>();
  auto* verb =
      AddVerb(world, "generate",
              "Makes up a building from a seed: its world, the map a person with a tape makes of it, "
              "and a scenario.");
  verb->footer("Example: priamos world generate --kind corridor --seed 7 --into generated");
  verb->add_option("--kind", options->kind, "what to make")
      ->capture_default_str()
      ->check(CLI::IsMember(world::GeneratedKinds()));
  verb->add_option("--seed", options->seed, "the same seed makes the same building")->capture_default_str();
  verb->add_option("--into", options->into, "folder of a deployment; made when it is not there")->required();
  verb->add_flag("--there-and-back", options->there_and_back,
                 "the robot is sent to a place behind the door, and back; without: it passes the door");
  verb->add_flag("--follow", options->follow,
                 "the robot follows the corridor by sonar to its end; in a room it passes the door");
  verb->add_flag("--explore", options->explore, "the robot explores it without a plan");
  verb->add_flag("--force", options->force, "replace a world of the same kind and seed that is there");
  AddDeploymentOption(*verb, options->deployment);
  CompleteVerb(*verb, options, RunGenerate, exit_code, "the files' names as JSON");
}

}  // namespace

void AddWorldCommand(CLI::App& cli, int& exit_code) {
  auto* verb = AddVerb(cli, "world", "Simulated worlds: made up from a seed; what a world file may say.");
  verb->require_subcommand(1);
  AddGenerate(*verb, exit_code);
  auto* keys =
      AddVerb(*verb, "keys", "Every key of a world file with its unit, default and bounds, as TOML.");
  keys->footer("Example: priamos world keys");
  keys->callback([&exit_code] {
    PrintConfig(std::cout, OneOfEach());
    std::cout << std::flush;
    exit_code = 0;
  });
}

}  // namespace priamos::cli
