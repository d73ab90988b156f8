#include "cli/verbs/world/generated_files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "cli/scenario/scenario.hpp"
#include "common/config_printer.hpp"
#include "common/replace_file.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kMode = 0644;
/// The scenario whose processes a generated one has.
constexpr const char* kBaseScenario = "door";
/// A robot drives at 0.3 m/s and looks about now and then; nobody waits longer.
constexpr double kSlow_m_s = 0.1, kLongestWait_s = 60;
/// An exploration ends by itself.
constexpr double kExplore_s = 3600;

[[noreturn]] void RefuseFolder(const fs::path& path, const std::string& reason) {
  throw ConfigError(
      fmt::format("--into: expected a folder that can be written, got \"{}\": {}", path.string(), reason));
}

/// The configurations of the deployment, without its worlds, maps and scenarios.
void CopyDeployment(const fs::path& base, const fs::path& folder) {
  if (fs::exists(folder / "world.toml")) return;
  if (fs::exists(folder) && !fs::is_empty(folder))
    RefuseFolder(folder, "it is neither empty nor a deployment; next: name a new folder");
  fs::create_directories(folder);
  for (const auto& entry : fs::directory_iterator(base))
    if (entry.is_regular_file()) fs::copy_file(entry.path(), folder / entry.path().filename());
}

template <class T>
void Write(const fs::path& file, const std::string& about, const T& values) {
  std::ostringstream text;
  text << "# " << about << "\n";
  PrintConfig(text, values);
  fs::create_directories(file.parent_path());
  if (!ReplaceFile(file.string(), text.str(), false, kMode)) RefuseFolder(file, std::strerror(errno));
}

std::string InitialPose(const world::StartPlan& start, bool explores) {
  // The frame of an unknown floor is the pose that the robot is given.
  const double more_m = explores ? 0.01 : 0.1, more_deg = explores ? 0.2 : 3;
  return fmt::format(
      "localiser.estimator.initial={{x_m={:.4f},y_m={:.4f},yaw_deg={:.3f},position_error_m={:.2f},"
      "yaw_error_deg={:.1f}}}",
      start.x_m, start.y_m, start.yaw_deg, start.error_m + more_m, start.error_deg + more_deg);
}

double LengthOf(const std::vector<Pose2>& waypoints, const world::StartPlan& start) {
  double length_m = 5;
  Eigen::Vector2d at(start.x_m, start.y_m);
  for (const Pose2& waypoint : waypoints) {
    length_m += (waypoint.translation() - at).norm();
    at = waypoint.translation();
  }
  return length_m;
}

Scenario ScenarioOf(const world::GeneratedWorld& generated, const GeneratedFiles& files,
                    const std::vector<Pose2>& waypoints, GeneratedTask task, const fs::path& base) {
  const bool explores = task == GeneratedTask::kExplore;
  Scenario scenario = LoadScenario(base.string(), kBaseScenario);
  scenario.title = files.scenario;
  scenario.map = explores ? files.truth : files.map;
  scenario.landmark_id = generated.door_id;
  scenario.time_limit_s = std::ceil(LengthOf(waypoints, generated.world.start) / kSlow_m_s + kLongestWait_s);
  if (!waypoints.empty())
    scenario.story = task == GeneratedTask::kCorridor && generated.corridor_end ? "corridor" : "goto";
  if (explores) {
    scenario.story = "explore";
    scenario.time_limit_s = kExplore_s;
  }
  for (const Pose2& waypoint : waypoints)
    scenario.waypoints.push_back({waypoint.x, waypoint.y, Degrees(waypoint.yaw)});
  for (ScenarioProcess& process : scenario.processes) {
    if (process.module == "world") process.set = "world=" + files.world;
    if (process.module == "planner") process.set = "map=" + files.map;
    if (process.module == "robot") process.set = InitialPose(generated.world.start, explores);
  }
  return scenario;
}

}  // namespace

GeneratedFiles WriteGenerated(const world::GeneratedWorld& generated, const std::string& kind,
                              std::uint64_t seed, GeneratedTask task, const std::string& base,
                              const std::string& folder) {
  const std::string name = fmt::format("{}-{}", kind, seed);
  const GeneratedFiles files{name, "worlds/" + name + ".toml", "maps/" + name + ".toml",
                             "maps/" + name + "-true.toml"};
  const bool follows = task == GeneratedTask::kCorridor && generated.corridor_end;
  const bool round = task == GeneratedTask::kThereAndBack && !generated.round.empty();
  const std::vector<Pose2> waypoints = task == GeneratedTask::kExplore ? std::vector<Pose2>{}
                                       : follows                       ? std::vector{*generated.corridor_end}
                                       : round                         ? generated.round
                                                                       : generated.waypoints;
  const fs::path into(folder);
  try {
    CopyDeployment(base, into);
    const std::string by = fmt::format("priamos world generate --kind {} --seed {}", kind, seed);
    world::WorldPlan world = generated.world;
    world.map = files.truth;
    Write(into / files.truth, "The building as it is: " + by, generated.truth);
    const GroundPlan known = task == GeneratedTask::kExplore ? GroundPlan{} : generated.surveyed;
    Write(into / files.map, "The building as a person with a tape has it, or nothing: " + by, known);
    Write(into / files.world, "What stands and moves there: " + by, world);
    Write(into / ("scenarios/" + name + ".toml"), by, ScenarioOf(generated, files, waypoints, task, base));
  } catch (const fs::filesystem_error& error) {
    RefuseFolder(into, error.code().message());
  }
  return files;
}

}  // namespace priamos::cli
