#include "cli/process_group.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>

namespace priamos::cli {
namespace {

constexpr int kCannotExec = 127;

/// Between fork and exec only async-signal-safe calls are allowed.
[[noreturn]] void Exec(char* const* argv, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kCannotExec);  // the parent died before prctl
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execv(argv[0], argv);
  _exit(kCannotExec);
}

std::string LastLine(const std::string& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

std::string HowEnded(int status) {
  if (WIFSIGNALED(status))
    return fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace

void ProcessGroup::Start(const std::string& name, const std::vector<std::string>& arguments,
                         const std::string& output_file) {
  const int output = open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (output < 0) throw std::system_error(errno, std::generic_category(), output_file);
  std::vector<char*> argv;
  for (const auto& a : arguments)
    argv.push_back(const_cast<char*>(a.c_str()));  // execv's signature predates const
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) Exec(argv.data(), output, parent);
  const int error = errno;
  close(output);
  if (pid < 0) throw std::system_error(error, std::generic_category(), "fork for " + name);
  children_.push_back({name, pid, output_file, std::nullopt});
}

std::optional<std::string> ProcessGroup::FirstDead() {
  AllEnded();
  for (const auto& c : children_)
    if (c.status)
      return fmt::format("{} ended by itself, {}: {}", c.name, HowEnded(*c.status), LastLine(c.output_file));
  return std::nullopt;
}

bool ProcessGroup::AllEnded() {
  for (auto& c : children_) {
    int status = 0;
    if (!c.status && waitpid(c.pid, &status, WNOHANG) == c.pid) c.status = status;
  }
  return std::all_of(children_.begin(), children_.end(), [](const Child& c) { return c.status.has_value(); });
}

void ProcessGroup::End() {
  for (const auto& c : children_)
    if (!c.status) kill(c.pid, SIGTERM);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while (!AllEnded() && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (auto& c : children_) {
    if (c.status) continue;
    int status = 0;
    kill(c.pid, SIGKILL);
    waitpid(c.pid, &status, 0);
    c.status = status;
  }
}

}  // namespace priamos::cli
