#pragma once

#include <optional>

#include "bus/context.hpp"
#include "common/frame_store.hpp"
#include "head/camera_reader.hpp"
#include "head/head_config.hpp"
#include "head/picture_folder.hpp"

namespace priamos::head {

/// The pictures that notices name: from the frame grabber's memory, or, on a log, from the folder that was
/// kept beside it. Keeps those that are used, where that is wanted.
class PictureSource {
 public:
  /// Throws ConfigError when the folder with the pictures of a log does not exist.
  PictureSource(const HeadConfig& config, bus::Context& context);

  /// A picture to be used; nullopt where it is lost.
  std::optional<GreyImage> Read(const FrameNotice& frame);
  /// A picture that is only shown: it is not kept.
  std::optional<GreyImage> Show(const FrameNotice& frame) { return cameras_.Read(frame); }
  /// Whether it is one of a log's.
  bool recorded() const { return recorded_.has_value(); }
  /// Of a log: whether the head that was recorded used this picture, as far as it is still there. What it did
  /// not use, because the head moved, it did not keep.
  bool WasUsed(const FrameNotice& frame) const;
  /// Number of pictures that could not be kept.
  int n_not_kept() const { return n_not_kept_; }

 private:
  void Keep(const FrameNotice& frame, const GreyImage& image);

  bus::Context& context_;
  CameraReader cameras_;
  std::optional<PictureFolder> recorded_, kept_;
  int n_not_kept_ = 0;
};

}  // namespace priamos::head
