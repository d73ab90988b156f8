#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace priamos::cli {

/// Child processes of one run. Each one dies with its parent (PR_SET_PDEATHSIG), writes its console output to
/// a file, and is ended when the group is destroyed: SIGTERM, SIGKILL after two seconds.
class ProcessGroup {
 public:
  ProcessGroup() = default;
  ~ProcessGroup() { End(); }
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  /// Starts `arguments[0]` with the others. Throws std::system_error when it cannot be started.
  void Start(const std::string& name, const std::vector<std::string>& arguments,
             const std::string& output_file);
  /// A sentence about the first child that ended by itself, with its last words; nullopt while all run.
  std::optional<std::string> FirstDead();
  /// Ends all that still run and waits for them.
  void End();

 private:
  struct Child {
    std::string name;
    pid_t pid;
    std::string output_file;
    std::optional<int> status;
  };
  bool AllEnded();

  std::vector<Child> children_;
};

}  // namespace priamos::cli
