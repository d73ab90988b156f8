#pragma once

#include <array>

#include "head/core/doors/door_detection.hpp"
#include "head/core/doors/door_state.hpp"
#include "test/bench/figures.hpp"
#include "test/bench/vision/corridor_looks.hpp"

namespace priamos::bench {

/// How often one look tells the state of a door that it found: closed, ajar (2 to 30 degrees), open.
class StateTally {
 public:
  /// A door that was detected. With `verbose` prints what was wrong.
  void Add(const CorridorLook& look, const TrueDoor& truth, const head::DetectedDoor& door, bool verbose);
  void Print(Figures& figures) const;

 private:
  static constexpr double kLead = 2;          ///< of the log likelihoods
  std::array<std::array<int, 4>, 4> told_{};  ///< true state, told state
  double seconds_ = 0;
  int n_ = 0;
};

}  // namespace priamos::bench
