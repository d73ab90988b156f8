#pragma once

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "head/core/bodies/free_model_fix.hpp"
#include "test/bench/figures.hpp"

namespace priamos::bench {

/// What is asked of a series of fixes.
struct BodyGoals {
  double success_percent = 98;
  bool nees = true;
};

/// How a series of free-model fixes went: success is a fix within 1 % of the distance and 1 degree, wrong is
/// one beyond.
class BodyTally {
 public:
  void Add(const head::FreeModelFix& fix, const Eigen::Isometry3d& truth, double seconds);
  void Print(std::string_view title, const BodyGoals& goals, Figures& figures) const;
  int wrong() const { return wrong_; }
  int found() const { return found_; }

 private:
  int n_ = 0, found_ = 0, wrong_ = 0, silently_wrong_ = 0;
  double seconds_ = 0, slowest_ = 0;
  std::vector<double> nees_, nees_position_, shift_percent_, turn_deg_;
};

}  // namespace priamos::bench
