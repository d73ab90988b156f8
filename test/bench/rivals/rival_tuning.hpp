#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "test/bench/rivals/dynamic_window.hpp"
#include "test/bench/rivals/mrpt_methods.hpp"
#include "test/bench/rivals/rival_driver.hpp"

namespace priamos::bench {

/// A rival of the table and its parameters.
struct RivalTuning {
  std::string name, method = "window";  ///< nd, full_eval or window
  /// around: the circle around the base. within: the one in it, as wide as the base; it needs the heading
  /// held along the way. rectangle: the base as it is.
  std::string shape = "around";
  RivalConfig drive;
  MrptConfig mrpt;
  DynamicWindowConfig window;

  void Describe(Archive& a);
  /// Radius of the shape [m]; 0 for the rectangle.
  double Radius() const;
};

/// test/bench/rivals/tuning.toml.
struct Tuning {
  std::vector<RivalTuning> rivals;

  void Describe(Archive& a) { a.List("rivals", rivals, "drivers beside the robot"); }
};

}  // namespace priamos::bench
