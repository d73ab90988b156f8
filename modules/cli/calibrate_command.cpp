#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "cli/commands.hpp"
#include "cli/factories.hpp"

namespace priamos::cli {
namespace {

constexpr auto kTimeLimit = std::chrono::minutes(10);

struct CalibrateOptions {
  std::string deployment = "config/sim";
  std::string world = "worlds/calibration.toml";
  std::string output;
  std::uint64_t seed = 1;
};

/// `world` and `head --calibrate` before the reference object, in lockstep.
int Calibrate(const CalibrateOptions& options) {
  const auto config = [&](const char* name) {
    return (std::filesystem::path(options.deployment) / name).string();
  };
  const bus::Schema schema = bus::OwnTypes();
  const Time start = FromUtime(1'000'000'000);
  const auto log = [&](Time now, std::string_view process, bus::Level, std::string_view text) {
    std::cout << fmt::format("{:6.1f} s  {}: {}", Seconds(now - start), process, text) << std::endl;
  };
  bus::Lockstep lockstep(schema, {.seed = options.seed, .start = start, .log = log});
  lockstep.AddBus("onboard");
  lockstep.AddApp(FactoryFor("world"), "onboard", {config("world.toml"), {"world=" + options.world}});
  ConfigSource head{config("head.toml"), {"mode=calibrate"}};
  if (!options.output.empty())
    head.overrides.push_back("calibration=" + std::filesystem::absolute(options.output).string());
  lockstep.AddApp(FactoryFor("head"), "onboard", head);
  if (lockstep.RunUntil(start + kTimeLimit)) return lockstep.exit_code();
  std::cerr << "priamos calibrate: the head did not finish within 10 simulated minutes\n";
  return 1;
}

}  // namespace

void AddCalibrateCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<CalibrateOptions>();
  auto* verb = cli.add_subcommand("calibrate",
                                  "Calibrate the simulated KASTOR head before its reference object (a real "
                                  "one: priamos-head --calibrate).");
  verb->footer("Example: priamos calibrate --output kastor.yaml");
  verb->add_option("--deployment", options->deployment, "folder of configurations")->capture_default_str();
  verb->add_option("--world", options->world,
                   "world file with the reference object, relative to the deployment")
      ->capture_default_str();
  verb->add_option("--output", options->output, "table to write; without it the one head.toml names");
  verb->add_option("--seed", options->seed, "noise, and how exactly the object was placed")
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = Calibrate(*options); });
}

}  // namespace priamos::cli
