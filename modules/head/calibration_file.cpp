#include "head/calibration_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/config.hpp"
#include "head/core/calibration/calibration_table.hpp"

namespace priamos::head {
namespace {

constexpr const char* kNextStep =
    "make one with `priamos-head --calibrate`, or for the simulated head `priamos calibrate`";

}  // namespace

std::vector<CalibratedSetup> LoadSetups(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw ConfigError(
        fmt::format("{}: expected a calibration table, got no readable file; {}", path, kNextStep));
  auto setups = FromYaml(text.str());
  if (!setups) throw ConfigError(fmt::format("{}: {}; {}", path, setups.reason(), kNextStep));
  return *setups;
}

void SaveSetups(const std::string& path, const std::vector<CalibratedSetup>& setups) {
  const std::string temporary = path + ".new";
  std::ofstream file(temporary, std::ios::trunc);
  file << ToYaml(setups);
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", temporary));
  std::filesystem::rename(temporary, path);
}

}  // namespace priamos::head
