#include "test/cli/priamos_answer.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "cli/front/run_cli.hpp"
#include "cli/verbs/commands.hpp"

namespace priamos::cli {

PriamosAnswer Priamos(const std::vector<std::string>& words) {
  for (const char* variable : {"PRIAMOS_BUS", "PRIAMOS_ROBOT", "PRIAMOS_TTL", "PRIAMOS_NETWORK"})
    unsetenv(variable);
  std::vector<std::string> line{"priamos"};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : line) argv.push_back(word.data());
  PriamosAnswer answer;
  int exit_code = 0;
  CLI::App cli("all verbs", "priamos");
  AddCommands(cli, exit_code);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  answer.exit_code = RunCli(cli, static_cast<int>(argv.size()), argv.data(), exit_code);
  answer.err = testing::internal::GetCapturedStderr();
  answer.out = testing::internal::GetCapturedStdout();
  return answer;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string FileContent(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

}  // namespace priamos::cli
