#pragma once

#include <string>
#include <vector>

#include "head/core/calibration/rig/head_quality.hpp"

namespace priamos::head {

/// Errors that F does not contain.
struct ReportedErrors {
  ReconstructionErrors stereo;
  Outcome<HeldOutErrors> held_out = Refusal{"not predicted"};

  /// One line for a person.
  std::string ToText() const;
};

/// Writes `index.html` with its pictures into `folder`: where discs were seen and by how much the calibrated
/// head misses them, F of pictures that took no part, the error of reconstruction, F over the table, lens
/// parameters over zoom and focus, mechanics, and the 11 physical parameters of every camera at `at`. Throws
/// std::runtime_error if a file cannot be written.
void WriteCalibrationReport(const std::string& folder, const std::vector<HeadView>& views,
                            const HeadCalibration& result, const ReportedErrors& errors,
                            const HeadSetting& at);

/// The 11 physical parameters of one calibrated camera, for a person; why not if they cannot be determined.
std::string PhysicalParameters(const HeadModel& head, const HeadSetting& at, int camera);

}  // namespace priamos::head
