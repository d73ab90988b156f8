#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace priamos {

/// What a command said and how it ended.
struct ShellAnswer {
  int exit_code = -1;
  std::string text;  ///< standard output and standard error
};

/// Runs `command` in a shell.
inline ShellAnswer RunShell(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  ShellAnswer answer;
  std::array<char, 4096> buffer;
  while (fgets(buffer.data(), buffer.size(), pipe)) answer.text += buffer.data();
  const int status = pclose(pipe);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

}  // namespace priamos
