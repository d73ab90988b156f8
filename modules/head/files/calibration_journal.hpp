#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// A disc of the reference object in one picture.
struct SeenDisc {
  int disc = 0;                             ///< index in ReferenceObject::discs
  double u_px = 0, v_px = 0, sigma_px = 0;  ///< its centroid
};

/// What all cameras saw at one setting of a calibration.
struct CalibrationExposure {
  HeadSetting setting;  ///< the setting that the motors reported
  /// Left, right, third; none where the object was not recognised.
  std::vector<std::vector<SeenDisc>> cameras;
};

/// What a calibration has measured so far, in a file beside its table: one line of JSON per finished setting,
/// written at once. An interrupted calibration goes on where it stopped; one whose plan or object has changed
/// begins anew.
class CalibrationJournal {
 public:
  /// Journal in the file `path`; `fingerprint` stands for everything that must not change between two runs.
  CalibrationJournal(std::string path, std::string fingerprint, int discs);

  /// The finished settings of the run before, in order; a line that was cut off ends them. Rewrites the file
  /// to just these, so that Add can go on. Throws std::runtime_error if it cannot be written.
  std::vector<CalibrationExposure> Resume();
  /// Adds a finished setting. Throws std::runtime_error if its line cannot be written.
  void Add(const CalibrationExposure& exposure);
  /// Removes the file, because the calibration is complete.
  void Remove();

 private:
  std::vector<CalibrationExposure> Read() const;
  std::string path_, fingerprint_;
  int discs_;
  std::ofstream file_;
};

/// A short hash (FNV-1a, 64 bits) of a text, as hexadecimal digits.
std::string Fingerprint(const std::string& text);

}  // namespace priamos::head
