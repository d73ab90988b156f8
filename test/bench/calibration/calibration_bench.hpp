#pragma once

#include "common/random.hpp"
#include "test/bench/figures.hpp"

namespace priamos::bench {

/// What a run of the bench is asked to do.
struct CalibrationOptions {
  std::uint64_t seed = 1;
  int scale = 1;  ///< by which samples are divided

  /// An independent stream for one figure.
  Rng Stream(std::string_view figure) const { return Rng::Stream(seed, figure); }
};

/// Error of the centre of a disc, beside other detectors on the same images.
void BenchDiscs(const CalibrationOptions& options, Figures& figures);
/// Which disc is which, and the time of a whole frame.
void BenchLabels(const CalibrationOptions& options, Figures& figures);
/// The DLT: failures and time.
void BenchDlt(const CalibrationOptions& options, Figures& figures);
/// Depth by two cameras that were calibrated from one image each.
void BenchDepth(const CalibrationOptions& options, Figures& figures);
/// The table over zoom and focus, with and without approaching from one side.
void BenchTable(const CalibrationOptions& options, Figures& figures);
/// The line of the laser, and its plane.
void BenchLaser(const CalibrationOptions& options, Figures& figures);
/// The alarm at run time: false ones, and those that should be.
void BenchDrift(const CalibrationOptions& options, Figures& figures);

}  // namespace priamos::bench
