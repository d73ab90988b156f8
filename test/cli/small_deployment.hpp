#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "test/support/temporary_folder.hpp"

namespace priamos::cli {

/// A deployment whose scenarios start no process: their stories end at the time limit, in a moment.
class SmallDeployment {
 public:
  SmallDeployment() {
    namespace fs = std::filesystem;
    fs::create_directories(folder_ / "scenarios");
    fs::create_directory(folder_ / "maps");
    fs::copy_file(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml", folder_ / "maps/door.toml");
    AddScenario("wait", "");
  }
  /// A scenario of one second with `more` in its file.
  void AddScenario(const std::string& name, const std::string& more) {
    std::ofstream(folder_ / "scenarios" / (name + ".toml"))
        << "title = \"nobody comes\"\nlandmark_id = 1\ntime_limit_s = 1\nmap = \"maps/door.toml\"\n"
        << more;
  }
  /// For --deployment.
  std::string name() const { return folder_.path().string() + "/"; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

}  // namespace priamos::cli
