#pragma once

#include <optional>
#include <string>

#include "common/time.hpp"
#include "robot/last_word.hpp"

namespace priamos::robot {

/// Carries a latched e-stop over a restart: when it is written down, and what follows when that fails.
class EstopMemory {
 public:
  /// Reads what the process before left in the file `path`; an empty path keeps nothing. Throws as
  /// LastWordFile::Load does.
  explicit EstopMemory(std::string path);

  /// Whether the process before was killed, or lost its power, while it could drive.
  bool crashed() const { return last_ == LastWord::kRunning; }
  /// Why the base starts with the e-stop latched; empty when it does not.
  const std::string& why_latched() const { return why_latched_; }

  /// Writes down that the process drives the base. Throws as LastWordFile::Save does.
  void Begin(bool estop);
  /// Writes down that it ended in order. Throws as LastWordFile::Save does.
  void End(bool estop);
  /// Forgets the e-stop, before the drive is re-armed: a re-arming that is forgotten is better than one too
  /// many. Returns why it cannot be re-armed; empty when it can.
  std::string Forget();
  /// Writes a latched e-stop down; call it at every tick while it is latched, it writes once. Returns why it
  /// failed, and tries again a second later; empty when it is written, or that second is not over.
  std::string Keep(Time now);

 private:
  LastWordFile file_;
  LastWord last_;
  std::string why_latched_;
  std::optional<Time> again_;  ///< a failed Keep is tried again
};

}  // namespace priamos::robot
