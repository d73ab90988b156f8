#pragma once

#include <array>

namespace priamos::robot {

/// What two fixes say of the wheels between them, in one direction.
struct SlipResidual {
  double change = 0;     ///< what the wheels missed: of the turn [rad], or across the way [m]
  double by_slip = 0;    ///< its variance by slip, at a factor of 1
  double by_fixes = 0;   ///< its variance by the errors of both fixes
  double forward_m = 0;  ///< driven between them
};

/// How likely residuals are at each of a grid of factors by which the variance of the slip may differ from
/// the configured one. A constant error per metre, which the wheels' radii make, is not slip: it is
/// marginalised.
class SlipEvidence {
 public:
  static constexpr int kFactors = 31;
  /// The logarithm of a factor of the grid.
  static double LogFactor(int k);

  /// `constant_sigma`: of the constant error, per metre.
  explicit SlipEvidence(double constant_sigma) : constant_sigma_(constant_sigma) {}
  /// False: it is no number, and tells nothing.
  bool Add(const SlipResidual& residual);
  double LogLikelihood(int k) const;

 private:
  /// Sums over the residuals for one factor.
  struct Sums {
    double log_variances = 0, squares = 0, lever = 0, constant = 0;
  };

  double constant_sigma_;
  std::array<Sums, kFactors> sums_{};
};

/// How much more or less the wheels slip here than the odometry's noise says, as a factor of the variance:
/// floors differ, rollers wear. Landmark fixes that follow each other tell it: by how much the base turned,
/// and went aside, between them otherwise than the wheels said. Errors that both fixes share cancel. The
/// posterior over a grid of factors; the prior is log-normal around 1.
class SlipScale {
 public:
  void AddTurn(const SlipResidual& residual) { Add(turn_, residual); }
  void AddAcross(const SlipResidual& residual) { Add(across_, residual); }
  /// The mean of the posterior; 1 before anything was told.
  double factor() const;

 private:
  void Add(SlipEvidence& evidence, const SlipResidual& residual);
  double LogPosterior(int k) const;

  SlipEvidence turn_{0.004};     ///< [rad/m]
  SlipEvidence across_{0.0025};  ///< [m/m]
  bool told_ = false;
};

}  // namespace priamos::robot
