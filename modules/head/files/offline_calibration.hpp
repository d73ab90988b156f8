#pragma once

#include <optional>
#include <string>
#include <vector>

#include "head/core/calibration/targets/chessboard.hpp"
#include "head/core/calibration/targets/dot_target.hpp"

namespace priamos::head {

/// A calibration from files; no robot needed. Either `points` or `photographs`.
struct OfflineCalibration {
  std::vector<std::string> points;       ///< one file of `X Y Z u v` lines per camera
  std::vector<std::string> photographs;  ///< one camera's of a flat target, or one per camera of `object`
  std::string object;                    ///< TOML of the reference object; empty: `target`
  DotTarget target;
  std::optional<Chessboard> chessboard;  ///< instead of `target`
  int width_px = 0, height_px = 0;       ///< size of the images of `points`; 0: the centre is not constrained
};

/// What a calibration from files says.
struct OfflineReport {
  std::string json;   ///< the result, for programs
  std::string notes;  ///< what was done to the images, for a person; whole lines, mostly none
};

/// Calibrates and describes the result as JSON: per camera F (equation 7) of the plain DLT matrix and after
/// refinement, leave-one-out and held-out F, K, distortion, the 11 physical parameters, the matrix; and the
/// 3-D error of reconstructing the points that several cameras saw. Throws ConfigError with one sentence,
/// which names file and line, for what cannot be read or does not determine a camera.
OfflineReport CalibrateFromFiles(const OfflineCalibration& input);

}  // namespace priamos::head
