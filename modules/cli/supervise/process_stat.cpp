#include "cli/supervise/process_stat.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>

namespace priamos::cli {

/// The third field of /proc/PID/stat, behind the name in brackets.
bool IsStopped(pid_t pid) {
  std::string stat;
  std::getline(std::ifstream(fmt::format("/proc/{}/stat", pid)), stat);
  const auto name_end = stat.rfind(')');
  return name_end != std::string::npos && stat.size() > name_end + 2 && stat[name_end + 2] == 'T';
}

/// The second number of /proc/PID/schedstat [ns].
Duration WaitedForProcessor(pid_t pid) {
  std::int64_t ran_ns = 0, waited_ns = 0;
  std::ifstream(fmt::format("/proc/{}/schedstat", pid)) >> ran_ns >> waited_ns;
  return std::chrono::duration_cast<Duration>(std::chrono::nanoseconds(waited_ns));
}

}  // namespace priamos::cli
