#include "head/files/calibration_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/config.hpp"
#include "common/replace_file.hpp"
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
  if (!ReplaceFile(path, ToYaml(model), false, 0644))
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

}  // namespace priamos::head
