#include <fmt/format.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <iostream>

#include "bus/log/log_reader.hpp"
#include "bus/output_comparison.hpp"
#include "bus/own_types.hpp"
#include "bus/replay.hpp"
#include "bus/wire/typed_message.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/path_override.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/replay_verdict.hpp"
#include "cli/verbs/run/commands.hpp"
#include "common/config.hpp"
#include "head/head_messages.hpp"
#include "head/picture_folder.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kDifferent = 1;

struct VerifyOptions {
  std::string log, module, config, pictures;
  std::string deployment = "sim";
  std::vector<std::string> set;
  bool json = false;
};

ConfigSource SourceOf(const VerifyOptions& options) {
  std::vector<std::string> set = options.set;
  if (!options.pictures.empty()) set.push_back(PathOverride("pictures", options.pictures));
  if (!options.config.empty()) return {options.config, set};
  const std::filesystem::path folder = FolderOfDeployment(options.deployment);
  return {(folder / (options.module + ".toml")).string(), set};
}

/// What else than messages a module's outputs come from; empty when it is nothing.
std::string UnrecordedInput(const std::string& module) {
  if (module == "console") return "what people did on its page is in no log";
  if (module == "head")
    return "its pictures are in no log: lockstep --pictures keeps them, --pictures gives them";
  if (module == "radio") return "what came over the line is in no log";
  if (module == "teleop") return "what the hand did is in no log";
  if (module == "world") return "its scenario and seed are in no log: give them with --set";
  return "";
}

void Print(const VerifyOptions& options, const bus::Replay& replay, const bus::OutputComparison& comparison) {
  std::cout << fmt::format("{}: {} messages fed to {}\n", options.log, replay.fed(), options.module);
  std::cout << fmt::format("{:<20} {:>9} {:>9} {:>9}\n", "channel", "recorded", "replayed", "equal");
  for (const auto& [name, c] : comparison.channels)
    std::cout << fmt::format("{:<20} {:>9} {:>9} {:>9}\n", name, c.recorded, c.replayed, c.equal);
  for (const auto& line : comparison.differences) std::cout << line << "\n";
  const std::string unrecorded = UnrecordedInput(options.module);
  if (comparison.equal) {
    std::cout << "every byte is as it was recorded\n";
  } else {
    std::cout << (unrecorded.empty()
                      ? "DIFFERENT\n"
                      : fmt::format("DIFFERENT, which {} may be: {}\n", options.module, unrecorded));
  }
}

/// Without its pictures a head does nothing that it did. Which of them it used is not known before it runs: a
/// folder that has some is good.
void RequirePictures(const VerifyOptions& options, const bus::Schema& schema) {
  const head::PictureFolder folder(options.pictures);
  std::string first;
  int n = 0;
  for (bus::LogReader reader(options.log); const auto event = reader.Next();) {
    if (event->channel != channels::kCameraFrame.name) continue;
    const auto message = bus::DecodeChecked<camera_frame_t>(schema, event->bytes);
    if (!message) continue;
    const head::FrameNotice frame = head::FromMessage(*message);
    if (folder.Has(frame)) return;
    if (n++ == 0) first = folder.FileOf(frame).string();
  }
  if (n > 0)
    throw std::runtime_error(
        fmt::format("{}: expected a picture of {}, got none; it is the first of {}, none "
                    "of which is there",
                    first, options.log, n));
}

/// What the module sent then and may send again: a head that is given its pictures takes none.
std::vector<bus::Output> Comparable(std::vector<bus::Output> recorded, const VerifyOptions& options) {
  if (!options.pictures.empty())
    std::erase_if(recorded, [](const bus::Output& o) { return o.channel == channels::kCameraTrigger.name; });
  return recorded;
}

int Verify(const VerifyOptions& options) {
  if (!options.pictures.empty() && options.module != "head")
    throw std::runtime_error(fmt::format("--pictures: expected with --module head, got {}", options.module));
  const bus::Schema schema = bus::OwnTypes();
  if (!options.pictures.empty()) RequirePictures(options, schema);
  const ConfigSource source = SourceOf(options);
  bus::Replay replay(FactoryFor(options.module), source, schema, options.log, {source.Folder()});
  std::vector<bus::Output> replayed;
  replay.Run([&](const bus::Output& output) { replayed.push_back(output); });
  if (replay.recorded().empty())
    throw std::runtime_error(
        fmt::format("{}: expected messages that {} sent, got none", options.log, options.module));
  const auto comparison = bus::CompareOutputs(Comparable(replay.recorded(), options), replayed, schema);
  if (options.json) {
    std::cout << JsonLine(ReplayVerdict{.log = options.log,
                                        .module = options.module,
                                        .fed = replay.fed(),
                                        .skipped_bytes = replay.skipped_bytes(),
                                        .comparison = comparison})
              << "\n";
  } else {
    Print(options, replay, comparison);
  }
  return comparison.equal ? 0 : kDifferent;
}

}  // namespace

void AddReplayCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<VerifyOptions>();
  auto* replay =
      AddVerb(cli, "replay",
              "Show a log as the station would have; run a module from it (see also --bus file://LOG).");
  replay->require_subcommand(1);
  AddReplayShowVerb(*replay, exit_code);
  auto* verb = AddVerb(
      *replay, "verify",
      "Feed a module what a log recorded and compare what it sends with what it sent then, byte for byte.");
  verb->footer(
      "Exact for robot, planner and, with --pictures, head in logs of lockstep runs; the log of a live bus "
      "has the\n"
      "recorder's times, and what console, world, radio and teleop send comes from more than messages.\n"
      "Example: priamos replay verify logs/recorded/door-onboard.lcmlog --module robot");
  verb->add_option("log", options->log, "LCM log")->required()->check(CLI::ExistingFile);
  verb->add_option("--module", options->module, "whose messages to compare")
      ->required()
      ->check(CLI::IsMember({"robot", "planner", "head", "teleop", "console", "radio", "world"}));
  verb->add_option("--config", options->config, "its configuration; none: <deployment>/<module>.toml");
  AddDeploymentOption(*verb, options->deployment);
  verb->add_option("--pictures", options->pictures,
                   "folder with the pictures of that run, for the head, which takes none then "
                   "(CAMERA_TRIGGER is not compared)")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--set", options->set, "KEY=VALUE on top of the file");
  CompleteVerb(*verb, options, Verify, exit_code);
}

}  // namespace priamos::cli
