#include "head/files/calibration_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/config.hpp"
#include "head/core/calibration/rig/calibration_table.hpp"

namespace priamos::head {
namespace {

constexpr const char* kNextStep =
    "make one with `priamos-head --calibrate`, or for the simulated head `priamos calibrate`";

}  // namespace

HeadModel LoadHeadModel(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw ConfigError(
        fmt::format("{}: expected a calibration table, got no readable file; {}", path, kNextStep));
  const auto model = FromYaml(text.str());
  if (!model) throw ConfigError(fmt::format("{}: {}; {}", path, model.reason(), kNextStep));
  return *model;
}

void SaveHeadModel(const std::string& path, const HeadModel& model) {
  const std::string temporary = path + ".new";
  std::ofstream file(temporary, std::ios::trunc);
  file << ToYaml(model);
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", temporary));
  std::filesystem::rename(temporary, path);
}

}  // namespace priamos::head
