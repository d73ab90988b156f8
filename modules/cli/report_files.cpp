#include "cli/report_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/report_html.hpp"
#include "cli/report_picture.hpp"

namespace priamos::cli {
namespace {

void WriteFile(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

DoorPlan LoadDoor(const std::string& map_file, int id) {
  const auto plan = LoadConfig<GroundPlan>(map_file);
  const DoorPlan* door = plan.FindDoor(id);
  if (!door) throw ConfigError(fmt::format("{}: doors: expected a door with id {}, got none", map_file, id));
  return *door;
}

void WriteReport(const RunRecord& record, const Summary& summary, const RunInfo& info,
                 const std::string& map_file, const std::filesystem::path& folder) {
  const auto plan = LoadConfig<GroundPlan>(map_file);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", DrawRun(record, summary, info, plan), png);
  WriteFile(folder / "summary.json", ToJson(summary).dump(2) + "\n");
  WriteFile(folder / "run.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  WriteFile(folder / "report.html", ReportPage(record, summary, png));
}

}  // namespace priamos::cli
