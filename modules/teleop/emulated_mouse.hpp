#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/pilot/stick.hpp"

namespace priamos::teleop {

/// The mouse's end of a serial line: a Magellan out of nothing, for demonstrations and tests. Time is an
/// argument; the caller moves the bytes.
class EmulatedMouse {
 public:
  explicit EmulatedMouse(int full_scale) : full_scale_(full_scale) {}

  /// What the computer sent. Returns the answers.
  std::string Hear(std::string_view bytes);
  /// Where the hand is now. Returns the packets that are due: keys when they change, motion every 40 ms while
  /// the cap is deflected, and once when it comes to rest. Nothing before the computer has asked for it.
  std::string Move(const Stick& hand, Time now);
  bool awake() const { return awake_; }

 private:
  Stick Trembling(Stick hand);

  int full_scale_;
  bool awake_ = false, trembles_ = false;
  std::string line_;
  Stick last_;
  std::optional<Time> sent_;
};

}  // namespace priamos::teleop
