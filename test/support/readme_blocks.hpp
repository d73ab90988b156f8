#pragma once

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "test/support/project_files.hpp"

namespace priamos {

/// Commands that a README shows together: a fenced block of shell, or indented lines that begin with a
/// program of ours.
struct ReadmeBlock {
  std::filesystem::path file;  ///< of the README, from the source folder
  int line = 0;                ///< of the first command, from 1
  std::vector<std::string> commands;
};
/// Name of a block in reports of googletest.
inline void PrintTo(const ReadmeBlock& block, std::ostream* out) {
  *out << block.file.string() << ':' << block.line;
}

/// Without the comment at its end; empty when the line is nothing else.
inline std::string CommandIn(const std::string& line) {
  static const std::regex kComment(R"((^|\s+)#\s.*$)");
  return std::regex_replace(line, kComment, "");
}

/// The blocks of one README, in order.
inline std::vector<ReadmeBlock> BlocksOf(const std::filesystem::path& readme) {
  static const std::regex kShell("```(sh|bash|shell|console)"),
      kOurs(R"(    ((build/bin/)?priamos\S*|scripts/\S+|cmake) .*)");
  std::vector<ReadmeBlock> blocks;
  std::ifstream file(PRIAMOS_SOURCE_DIR / readme);
  bool fenced = false, shell = false, open = false;
  int number = 0;
  const auto add = [&](const std::string& command) {
    if (command.empty()) return;
    if (!open) blocks.push_back({readme, number, {}});
    open = true;
    blocks.back().commands.push_back(command);
  };
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.starts_with("```")) {
      fenced = !fenced;
      shell = fenced && std::regex_match(line, kShell);
      open = false;
    } else if (fenced) {
      for (std::string rest; line.ends_with('\\') && std::getline(file, rest); ++number)
        line = line.substr(0, line.size() - 1) + rest;
      if (shell) add(CommandIn(line));
    } else if (std::regex_match(line, kOurs)) {
      add(CommandIn(line.substr(4)));
    } else if (!line.empty()) {
      if (open && line.starts_with("    ")) blocks.pop_back();  // text that only looks like commands
      open = false;
    }
  }
  return blocks;
}

/// Blocks of every README of the project.
inline std::vector<ReadmeBlock> ReadmeBlocks() {
  std::vector<ReadmeBlock> all;
  for (const auto& file : ProjectFiles()) {
    if (file.filename() != "README.md") continue;
    const auto blocks = BlocksOf(file);
    all.insert(all.end(), blocks.begin(), blocks.end());
  }
  return all;
}

}  // namespace priamos
