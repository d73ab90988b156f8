#pragma once

#include <string>
#include <vector>

namespace priamos::cli {

/// What `priamos` said to a command line, and how it ended.
struct PriamosAnswer {
  int exit_code = -1;
  std::string out, err;
};

/// Runs `priamos WORDS...` with all its verbs in this process. The environment names no bus and no robot.
PriamosAnswer Priamos(const std::vector<std::string>& words);

/// The lines of `text`, without their ends.
std::vector<std::string> LinesOf(const std::string& text);

/// All of a file, byte for byte.
std::string FileContent(const std::string& file);

}  // namespace priamos::cli
