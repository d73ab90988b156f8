#pragma once

#include <filesystem>
#include <optional>

#include "common/frame_store.hpp"
#include "common/outcome.hpp"
#include "head/core/camera/frame_notice.hpp"

namespace priamos::head {

/// Pictures beside a log: a PGM file each, named by the middle of its exposure [us] and its camera, such as
/// 1700000000123456-left.pgm. From these and the log a head can be run again.
class PictureFolder {
 public:
  explicit PictureFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes a picture, whole or not at all; makes the folder. Returns the reason when that failed.
  std::optional<Refusal> Keep(const FrameNotice& frame, const GreyImage& image) const;
  bool Has(const FrameNotice& frame) const;
  /// The picture of a notice, as it was kept; else the reason why there is none.
  Outcome<GreyImage> Read(const FrameNotice& frame) const;
  std::filesystem::path FileOf(const FrameNotice& frame) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace priamos::head
