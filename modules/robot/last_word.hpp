#pragma once

#include <string>

namespace priamos::robot {

/// What the process that drives the base writes down for the next one.
enum class LastWord {
  kNone,     ///< there was no process before
  kEnded,    ///< it ended in order, with no e-stop latched
  kRunning,  ///< it was killed, or lost its power, with no e-stop latched
  kEstop,    ///< the e-stop was latched
};

/// Why the base starts with the e-stop latched; empty when it does not. An e-stop is lifted by re-arming and
/// by nothing else, so it outlives the process and a loss of power. After a crash the pose is that of the
/// configuration and a planner sends its path again by itself: that somebody looks first is an act of its
/// own.
std::string WhyLatched(LastWord last);

/// Keeps the last word in a file, which is replaced as a whole.
class LastWordFile {
 public:
  /// An empty `path` keeps nothing.
  explicit LastWordFile(std::string path) : path_(std::move(path)) {}

  /// What the process before left; a file that cannot be understood counts as kEstop. Throws
  /// std::runtime_error when there is one that cannot be read, or its folder cannot be written.
  LastWord Load() const;
  /// Survives a loss of power when it returns. Does nothing when `word` is written already. Throws
  /// std::runtime_error with one sentence when it cannot be written.
  void Save(LastWord word);

 private:
  std::string path_;
  LastWord saved_ = LastWord::kNone;
};

}  // namespace priamos::robot
