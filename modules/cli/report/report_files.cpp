#include "cli/report/report_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/report/report_html.hpp"
#include "cli/report/report_picture.hpp"
#include "common/config.hpp"
#include "common/drawing/raster.hpp"
#include "common/drawing/svg.hpp"

namespace priamos::cli {
namespace {

void WriteFile(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

std::optional<DoorPlan> LoadDoor(const std::string& map_file, int id, bool needed) {
  const auto plan = LoadConfig<GroundPlan>(map_file);
  const DoorPlan* door = plan.FindDoor(id);
  if (door) return *door;
  if (!needed) return std::nullopt;
  throw ConfigError(fmt::format("{}: doors: expected a door with id {}, got none", map_file, id));
}

std::string SummariesAsJson(const std::vector<Summary>& runs, JsonForm form) {
  const int indent = form == JsonForm::kIndented ? 2 : -1;
  if (runs.size() == 1) return ToJson(runs.front()).dump(indent);
  auto all = nlohmann::ordered_json::array();
  for (const Summary& run : runs) all.push_back(ToJson(run));
  return all.dump(indent);
}

void WriteReport(const RunRecord& record, const Summary& summary, const RunInfo& info,
                 const std::string& map_file, const std::filesystem::path& folder) {
  const auto plan = LoadConfig<GroundPlan>(map_file);
  const drawing::Drawing picture = DrawRun(record, summary, info, plan);
  const std::string svg = drawing::ToSvg(picture);
  WriteFile(folder / "summary.json", SummariesAsJson({summary}, JsonForm::kIndented) + "\n");
  WriteFile(folder / "run.svg", svg);
  WriteFile(folder / "run.png", drawing::ToPng(drawing::Paint(picture)));
  WriteFile(folder / "report.html", ReportPage(record, summary, svg));
}

}  // namespace priamos::cli
