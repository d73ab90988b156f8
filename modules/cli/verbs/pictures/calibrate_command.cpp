#include <fmt/format.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <iostream>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/pictures/commands.hpp"
#include "common/config.hpp"
#include "common/replace_file.hpp"
#include "head/files/laser_files.hpp"
#include "head/files/offline_calibration.hpp"

namespace priamos::cli {
namespace {

constexpr auto kTimeLimit = std::chrono::minutes(10);

struct CalibrateOptions {
  std::string deployment = "sim";
  std::string world = "worlds/calibration.toml";
  std::string output, laser, table;
  std::uint64_t seed = 1;
  head::OfflineCalibration files;
  std::vector<int> dots{6, 6}, chessboard, image_size;
  bool light = false, json = false;
};

/// A file of the deployment.
std::string FileOf(const CalibrateOptions& options, const char* name) {
  return std::filesystem::path(FolderOfDeployment(options.deployment)) / name;
}

/// Replaces `path` as a whole or not at all.
void WriteWhole(const std::string& path, const std::string& text) {
  if (!ReplaceFile(path, text + '\n', false, 0644))
    throw ConfigError(fmt::format("{}: expected a file that can be written, got none", path));
}

/// From photographs or lists of points: JSON to the output file or, without one, to standard output.
int CalibrateFiles(const CalibrateOptions& options) {
  head::OfflineCalibration files = options.files;
  files.target.columns = options.dots[0];
  files.target.rows = options.dots[1];
  files.target.dark = !options.light;
  if (!options.chessboard.empty())
    files.chessboard = {options.chessboard[0], options.chessboard[1], files.target.spacing_m};
  if (!options.image_size.empty()) {
    files.width_px = options.image_size[0];
    files.height_px = options.image_size[1];
  }
  const head::OfflineReport report = head::CalibrateFromFiles(files);
  std::cerr << report.notes;
  const bool to_pipe = options.output.empty() || options.output == "-";
  to_pipe ? void(std::cout << report.json << std::endl) : WriteWhole(options.output, report.json);
  return 0;
}

void AddFileOptions(CLI::App& verb, CalibrateOptions& options) {
  const auto positive = CLI::Range(1e-6, 1e6);
  auto* points = verb.add_option("--points", options.files.points,
                                 "lines `X Y Z u v` [m, px] of one camera; several files: several cameras");
  auto* photos =
      verb.add_option("--photo", options.files.photographs,
                      "photographs: of a flat target by one camera, or with --object one per camera");
  points->excludes(photos);
  verb.add_option("--object", options.files.object, "TOML of a reference object with discs")->needs(photos);
  verb.add_option("--dots", options.dots, "columns and rows of the dot target")
      ->expected(2)
      ->check(CLI::Range(3, 100))
      ->capture_default_str();
  verb.add_option("--chessboard", options.chessboard, "inner corners in a row and in a column; not dots")
      ->expected(2)
      ->check(CLI::Range(3, 100))
      ->needs(photos);
  verb.add_option("--spacing", options.files.target.spacing_m, "between dots, or side of a square [m]")
      ->check(positive)
      ->capture_default_str();
  verb.add_option("--radius", options.files.target.radius_m, "radius of a dot [m]")
      ->check(positive)
      ->capture_default_str();
  verb.add_flag("--light-dots", options.light, "the dots are lighter than their ground");
  verb.add_option("--image-size", options.image_size, "width and height behind --points [px]")
      ->expected(2)
      ->check(CLI::Range(64, 100000));
}

/// The plane of the line laser into a table; JSON to standard output.
int CalibrateLaser(const CalibrateOptions& options) {
  const std::string table = options.table.empty() ? FileOf(options, "kastor.yaml") : options.table;
  const head::OfflineReport report = head::CalibrateLaserFromFiles(options.laser, table, options.output);
  std::cerr << report.notes;
  std::cout << report.json << std::endl;
  return 0;
}

/// Where the simulated head's table goes: never into a deployment that was not named, which belongs to its
/// owner. Another seed is another head, so each has a folder of its own.
std::string TableOf(const CalibrateOptions& options) {
  namespace fs = std::filesystem;
  if (!options.output.empty()) return fs::absolute(options.output).string();
  const fs::path folder = fs::path(LogRoot("")) / fmt::format("calibration-seed-{}", options.seed);
  fs::create_directories(folder);
  return fs::absolute(folder / "kastor.yaml").string();
}

/// Runs `world` and `head --calibrate` before the reference object, in lockstep.
int Calibrate(const CalibrateOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const Time start = FromUtime(1'000'000'000);
  const auto log = [&](Time now, std::string_view process, bus::Level, std::string_view text) {
    (options.json ? std::cerr : std::cout)
        << fmt::format("{:6.1f} s  {}: {}", Seconds(now - start), process, text) << std::endl;
  };
  bus::Lockstep lockstep(schema, {.seed = options.seed, .start = start, .log = log});
  lockstep.AddBus("onboard");
  lockstep.AddApp(FactoryFor("world"), "onboard",
                  {FileOf(options, "world.toml"), {"world=" + options.world}});
  const ConfigSource head{FileOf(options, "head.toml"),
                          {"mode=calibrate", "calibration=" + TableOf(options)}};
  lockstep.AddApp(FactoryFor("head"), "onboard", head);
  const bool finished = lockstep.RunUntil(start + kTimeLimit);
  if (options.json)
    std::cout << JsonLine({{"finished", finished},
                           {"exit_code", finished ? lockstep.exit_code() : 1},
                           {"simulated_s", Seconds(lockstep.now() - start)}})
              << std::endl;
  if (finished) return lockstep.exit_code();
  std::cerr << "priamos calibrate: the head did not finish within 10 simulated minutes\n";
  return 1;
}

}  // namespace

void AddCalibrateCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<CalibrateOptions>();
  auto* verb = AddVerb(cli, "calibrate",
                       "Calibrate the simulated KASTOR head before its reference object (a real "
                       "one: priamos-head --calibrate), or cameras from files.");
  verb->footer(
      "Examples: priamos calibrate --output kastor.yaml\n"
      "          priamos calibrate --points left.txt --points right.txt\n"
      "          priamos calibrate --photo grid-*.pgm --dots 6 6 --spacing 0.03 --radius 0.0105\n"
      "          priamos calibrate --photo left*.jpg --chessboard 9 6 --spacing 0.025\n"
      "          priamos calibrate --laser laser.toml --table config/robot/kastor.yaml");
  AddDeploymentOption(*verb, options->deployment);
  verb->add_option("--world", options->world,
                   "world file with the reference object, relative to the deployment")
      ->capture_default_str();
  verb->add_option(
      "--output", options->output,
      "table to write, without it calibration-seed-N/kastor.yaml in the folder of logs; from files: JSON, "
      "without it to the terminal");
  verb->add_option("--seed", options->seed, "noise, and how exactly the object was placed")
      ->capture_default_str();
  auto* laser = verb->add_option("--laser", options->laser,
                                 "TOML that lists the third camera's pictures of the laser's line");
  verb->add_option("--table", options->table,
                   "calibration table that the laser goes into, without it kastor.yaml of the deployment")
      ->needs(laser);
  verb->add_flag("--json", options->json, "machine-readable; from files it always is");
  AddFileOptions(*verb, *options);
  verb->callback([options, &exit_code] {
    if (!options->laser.empty()) return void(exit_code = CalibrateLaser(*options));
    const bool from_files = !options->files.points.empty() || !options->files.photographs.empty();
    exit_code = from_files ? CalibrateFiles(*options) : Calibrate(*options);
  });
}

}  // namespace priamos::cli
