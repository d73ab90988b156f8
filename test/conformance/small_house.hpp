#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos {

/// A small house on which rules are tried: bus/low, bus/high, bus, modules/robot, and the messages.
class SmallHouse : public testing::Test {
 protected:
  SmallHouse() {
    Put("CMakeLists.txt",
        "add_subdirectory(lcmtypes)\nadd_subdirectory(bus)\nadd_subdirectory(modules/robot)\n");
    Put("lcmtypes/CMakeLists.txt", "add_library(lcmtypes STATIC ${embedded})\n");
    Put("bus/CMakeLists.txt",
        "# The wire.\nadd_subdirectory(low)  # below\nadd_subdirectory(high)\n"
        "priamos_library(bus LIBS bus_low\n  bus_high)\n");
    Put("bus/low/CMakeLists.txt", "priamos_library(bus_low)\n");
    Put("bus/high/CMakeLists.txt",
        "priamos_library(bus_high LIBS fmt::fmt)\n"
        "target_link_libraries(bus_high PRIVATE bus_low)  # why\n");
    Put("modules/robot/CMakeLists.txt", "priamos_module(robot LIBS lcmtypes bus)\n");
    Put("bus/low/a.hpp", "");
    Put("bus/high/b.hpp", "#include \"bus/low/a.hpp\"\n");
    Put("bus/c.hpp", "#include \"bus/high/b.hpp\"\n");
    Put("modules/robot/d.hpp",
        "#include \"bus/c.hpp\"\n#include <vector>\n#include \"priamos/pose_t.hpp\"\n");
  }
  void Put(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file) << text;
  }
  const std::filesystem::path& root() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace priamos
