#pragma once

#include <string>
#include <vector>

#include "test/bench/bus/owner_rig.hpp"

namespace priamos::bench {

/// What came of one trial in which two processes want to drive one base.
struct OwnerTrial {
  WheelWatch watch;
  int survivors = 0;
  bool right_one = false;  ///< the one that the rule names
  bool said = false;       ///< the other one ended with the right code and named the survivor
  Duration settled{};      ///< until one alone was left, or until the base was driven again
  std::string trouble;     ///< what was not as it should be; empty when all was
};

/// One way in which two owners meet.
struct OwnerKind {
  std::string name, what;
  OwnerTrial (*run)(OwnerRig& rig, int trial);
  bool meets;  ///< both command: it proves nothing when the board never heard the two
};

const std::vector<OwnerKind>& OwnerKinds();

}  // namespace priamos::bench
