#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bus/process_config.hpp"
#include "cli/floor/plan_grid.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/supervise/live_deployment.hpp"
#include "cli/supervise/up_state.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/map_text.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "cli/verbs/robot/map_picture.hpp"
#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "common/drawing/svg.hpp"
#include "common/learned/learned_plan.hpp"
#include "common/learned/wall_gaps.hpp"
#include "common/replace_file.hpp"
#include "lcmtypes/channels.hpp"
#include "planner/planner_config.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kNothing = 1;
constexpr unsigned kMode = 0644;

struct MapOptions {
  std::string deployment, file, svg, log_root;
  bool json = false;
};

struct ExportOptions {
  MapOptions map;
  std::string into;
  bool surveyed = false, json = false;
};

struct ResetOptions {
  BusOptions bus;
  bool json = false;
};

/// What a deployment's planner plans with.
struct Maps {
  GroundPlan plan;
  std::string file;  ///< of the learned map; empty: none is kept
  LearnedWalls learned;
  double fits_m = 1;  ///< width of a gap through which a route leads
};

std::string LogRootOf(const MapOptions& options) {
  const std::string named = LogRoot(options.log_root);
  return options.deployment.empty() ? LogRootInUse(named, std::string(bus::kDefaultRobot), "") : named;
}

/// Of a simulation the learned map is kept as long as it is up.
std::string FileOf(const MapOptions& options, const std::string& log_root, const fs::path& folder,
                   const planner::PlannerConfig& config) {
  if (!options.file.empty()) return options.file;
  if (!config.learned_map.empty()) return (folder / config.learned_map).lexically_normal().string();
  const auto up = ReadUpState(log_root);
  return up ? (fs::path(up->folder) / kLearnedMapFile).string() : "";
}

Maps MapsOf(const MapOptions& options) {
  const std::string log_root = LogRootOf(options);
  const ConfigSource planner = PlannerInUse(options.deployment, log_root);
  const fs::path folder = planner.Folder();
  const auto config = bus::LoadAppConfig<planner::PlannerConfig>(planner);
  Maps maps{LoadConfig<GroundPlan>((folder / config.map).lexically_normal().string()),
            FileOf(options, log_root, folder, config),
            {},
            config.footprint.width_m + 2 * config.go.route.least_margin_m};
  if (!options.file.empty() && !fs::exists(options.file))
    throw ConfigError(
        fmt::format("--file: expected a learned map, got \"{}\", which is not there", options.file));
  if (!maps.file.empty()) maps.learned = LoadLearnedWalls(maps.file);
  return maps;
}

nlohmann::ordered_json ToJson(const LearnedWall& wall) {
  return {{"id", wall.id},
          {"from_m", {wall.from().x(), wall.from().y()}},
          {"to_m", {wall.to().x(), wall.to().y()}},
          {"sigma_across_m", wall.sigma_across_m},
          {"sigma_yaw_deg", wall.sigma_yaw_deg},
          {"sigma_end_m", wall.sigma_end_m},
          {"seen_s", wall.seen_s},
          {"sightings", wall.sightings}};
}

nlohmann::ordered_json ToJson(const LearnedPoint& point) {
  return {{"id", point.id},
          {"at_m", {point.x_m, point.y_m}},
          {"sigma_m", point.sigma_m},
          {"seen_s", point.seen_s}};
}

nlohmann::ordered_json ToJson(const LearnedDoor& door, const GroundPlan& plan) {
  const DoorPlan* drawn = DoorOnPlan(door, plan);
  return {{"id", door.id},
          {"name", drawn ? nlohmann::ordered_json(drawn->name) : nlohmann::ordered_json(nullptr)},
          {"middle_m", {door.x_m, door.y_m}},
          {"yaw_deg", door.yaw_deg},
          {"width_m", door.width_m},
          {"sigma_along_m", door.sigma_along_m},
          {"sigma_across_m", door.sigma_across_m},
          {"state", door.state},
          {"changed_s", door.changed_s},
          {"seen_s", door.seen_s},
          {"looks", door.looks}};
}

nlohmann::ordered_json ToJson(const LearnedObject& object) {
  return {{"id", object.id},
          {"kind", object.kind},
          {"front_m", {object.x_m, object.y_m}},
          {"yaw_deg", object.yaw_deg},
          {"width_m", object.width_m},
          {"depth_m", object.depth_m},
          {"bottom_m", object.bottom_m},
          {"top_m", object.top_m},
          {"sigma_along_m", object.sigma_along_m},
          {"sigma_across_m", object.sigma_across_m},
          {"sigma_yaw_deg", object.sigma_yaw_deg},
          {"seen_s", object.seen_s},
          {"looks", object.looks}};
}

void PrintJson(const Maps& maps) {
  nlohmann::ordered_json json{{"file", maps.file}, {"revision", maps.learned.revision}};
  json["walls"] = nlohmann::ordered_json::array();
  for (const LearnedWall& wall : maps.learned.walls) json["walls"].push_back(ToJson(wall));
  json["points"] = nlohmann::ordered_json::array();
  for (const LearnedPoint& point : maps.learned.points) json["points"].push_back(ToJson(point));
  json["gaps"] = nlohmann::ordered_json::array();
  for (const WallGap& gap : GapsOf(maps.learned))
    json["gaps"].push_back({{"walls", {gap.before, gap.behind}},
                            {"middle_m", {gap.x_m, gap.y_m}},
                            {"width_m", gap.width_m},
                            {"sigma_width_m", gap.sigma_width_m}});
  json["doors"] = nlohmann::ordered_json::array();
  for (const LearnedDoor& door : maps.learned.doors) json["doors"].push_back(ToJson(door, maps.plan));
  json["things"] = nlohmann::ordered_json::array();
  for (const LearnedObject& object : maps.learned.objects) json["things"].push_back(ToJson(object));
  std::cout << json.dump() << "\n";
}

bool IsEmpty(const LearnedWalls& learned) {
  return learned.walls.empty() && learned.points.empty() && learned.doors.empty() && learned.objects.empty();
}

void Print(const Maps& maps) {
  const auto size = TableSize();
  const bool colour = isatty(STDOUT_FILENO) != 0;
  std::cout << MapDots(maps.plan, maps.learned, size.value_or(ScreenSize{}), colour);
  if (IsEmpty(maps.learned)) return;
  const double now_s =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  if (!maps.learned.walls.empty()) std::cout << MapTable(maps.learned, now_s, size);
  if (!maps.learned.points.empty()) std::cout << PointTable(maps.learned, now_s, size);
  if (!maps.learned.doors.empty()) std::cout << DoorTable(maps.plan, maps.learned, now_s, size);
  if (!maps.learned.objects.empty()) std::cout << ObjectTable(maps.learned, now_s, size);
}

/// 1 when nothing has been learned; the plan is shown all the same.
int Show(const MapOptions& options) {
  const Maps maps = MapsOf(options);
  if (options.json) {
    PrintJson(maps);
  } else {
    Print(maps);
  }
  if (!options.svg.empty() &&
      !ReplaceFile(options.svg, drawing::ToSvg(DrawMap(maps.plan, maps.learned)), false, kMode))
    throw ConfigError(fmt::format("--svg: expected a file that can be written, got \"{}\"", options.svg));
  if (!IsEmpty(maps.learned)) return 0;
  std::cerr << "priamos map: nothing has been learned of this building"
            << (maps.file.empty() ? ", and no planner keeps it" : " in " + maps.file)
            << "; next: priamos mission goto, while the planner runs\n";
  return kNothing;
}

/// Writes a plan in the form that the file's name asks for.
void WritePlan(const ExportOptions& options, const Maps& maps, const GroundPlan& plan) {
  constexpr double kCell_m = 0.05;
  const auto write = [](const fs::path& file, const std::string& text) {
    if (!ReplaceFile(file, text, false, kMode))
      throw ConfigError(fmt::format("into: expected a file that can be written, got \"{}\"", file.string()));
  };
  const fs::path into = options.into;
  if (into.extension() == ".svg") {
    write(into, drawing::ToSvg(DrawMap(maps.plan, options.surveyed ? LearnedWalls{} : maps.learned)));
  } else if (into.extension() == ".yaml") {
    const PlanGrid grid = GridOf(plan, kCell_m);
    const fs::path image = fs::path(into).replace_extension(".pgm");
    write(image, ToPgm(grid));
    write(into, ToYaml(grid, image.filename()));
  } else {
    std::ostringstream text;
    if (!options.surveyed)
      text << "# What was learned of a building: walls, and narrow gaps as doors without a leaf.\n";
    PrintConfig(text, plan);
    write(into, text.str());
  }
}

/// What was learned as a plan of its own, which a planner can be given as its map.
int Export(const ExportOptions& options) {
  const std::string extension = fs::path(options.into).extension();
  if (extension != ".toml" && extension != ".svg" && extension != ".yaml")
    throw ConfigError(
        fmt::format("into: expected a file called *.toml, *.svg or *.yaml, got \"{}\"", options.into));
  const Maps maps = MapsOf(options.map);
  const GroundPlan plan = options.surveyed ? maps.plan : PlanOf(maps.learned, maps.fits_m);
  const bool any = !plan.walls.empty();
  if (any) WritePlan(options, maps, plan);
  if (options.json)
    std::cout << nlohmann::ordered_json{{"file", any ? nlohmann::ordered_json(options.into) : nullptr},
                                        {"walls", plan.walls.size()},
                                        {"doors", plan.doors.size()}}
                     .dump()
              << "\n";
  else if (any)
    std::cout << fmt::format("{}: {} walls, {} doors\n", options.into, plan.walls.size(), plan.doors.size());
  if (!any)
    std::cerr << "priamos map export: "
              << (options.surveyed ? "the plan has no walls\n"
                                   : "nothing has been learned of this building\n");
  return any ? 0 : kNothing;
}

/// Orders it until the planner's map can only be empty: an order is cheap, and the planner logs it.
int Reset(const ResetOptions& options) {
  BusSession session("priamos map reset", options.bus, channels::kMissionStatus.name);
  auto statuses = session.node().SubscribeAll(channels::kMissionStatus);
  auto orders = session.node().Advertise(channels::kMapCommand);
  constexpr Duration kWait = std::chrono::seconds(2);
  bool heard = false, sent = false;
  session.Watch(
      session.now() + kWait, [&] { return sent; },
      [&] {
        if (statuses.Drain().empty() || sent) return;
        session.Heard();
        heard = sent = true;
        map_command_t order{};
        order.utime = ToUtime(session.now());
        order.action = map_command_t::RESET;
        orders.Publish(order);
      });
  if (options.json) std::cout << nlohmann::ordered_json{{"ordered", heard}}.dump() << "\n";
  if (heard && !options.json) std::cout << "the planner forgets what it has learned; the plan stays\n";
  return heard ? 0 : kNothing;
}

}  // namespace

void AddMapCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<MapOptions>();
  auto* map =
      AddVerb(cli, "map",
              "The plan and what was learned of the building (exit code 1: nothing); `reset` forgets it.");
  map->footer("Example: priamos map --svg building.svg");
  map->require_subcommand(0, 1);
  AddLiveDeploymentOption(*map, options->deployment);
  map->add_option("--file", options->file, "a learned map instead of the deployment's");
  map->add_option("--svg", options->svg, "draw it into this file as well");
  AddLogsOption(*map, options->log_root, "the deployment that is up");
  map->add_flag("--json", options->json, "machine-readable");
  map->callback([map, options, &exit_code] {
    if (map->get_subcommands().empty()) exit_code = Show(*options);
  });
  auto export_options = std::make_shared<ExportOptions>();
  auto* as_plan = AddVerb(*map, "export",
                          "Write what was learned as a ground plan that a planner can have as its map, as a "
                          "grid or a drawing (exit code 1: nothing was learned).");
  as_plan->footer("Example: priamos map export learned-plan.toml");
  as_plan
      ->add_option("into", export_options->into,
                   "*.toml: a ground plan; *.yaml: a grid for map_server, with its .pgm beside it; *.svg: a "
                   "drawing")
      ->required();
  as_plan->add_flag("--surveyed", export_options->surveyed, "the surveyed plan in place of what was learned");
  AddLiveDeploymentOption(*as_plan, export_options->map.deployment);
  as_plan->add_option("--file", export_options->map.file, "a learned map instead of the deployment's");
  AddLogsOption(*as_plan, export_options->map.log_root, "the deployment that is up");
  CompleteVerb(*as_plan, export_options, Export, exit_code);
  auto reset_options = std::make_shared<ResetOptions>();
  auto* reset =
      AddVerb(*map, "reset", "Have the planner forget what it has learned; the surveyed plan stays.");
  reset->footer("Example: priamos map reset");
  AddBusOption(*reset, reset_options->bus);
  CompleteVerb(*reset, reset_options, Reset, exit_code);
}

}  // namespace priamos::cli
