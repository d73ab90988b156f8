#pragma once

#include <array>

namespace priamos::robot {

/// How much more or less the wheels slip here than the odometry's noise says, as a factor of the variance:
/// floors differ, rollers wear. Landmark fixes that follow each other tell it: by how much the heading
/// changed between them otherwise than the wheels said. Errors that both fixes share cancel. The posterior
/// over a grid of factors; the prior is log-normal around 1. A constant turn per metre, which the
/// wheels' radii make, is not slip: it is marginalised.
class SlipScale {
 public:
  /// Two fixes: `change_rad` is what the wheels missed of the turn, of which `by_slip` is the variance at a
  /// factor of 1 and `by_fixes` that of both fixes; `forward_m` driven between them.
  void Add(double change_rad, double by_slip, double by_fixes, double forward_m);
  /// The mean of the posterior; 1 before anything was told.
  double factor() const;

 private:
  static constexpr int kFactors = 31;
  /// Sums over the pairs of fixes for one factor.
  struct Evidence {
    double log_variances = 0, squares = 0, lever = 0, turn = 0;
  };
  double LogPosterior(int k) const;

  std::array<Evidence, kFactors> evidence_{};
  bool told_ = false;
};

}  // namespace priamos::robot
