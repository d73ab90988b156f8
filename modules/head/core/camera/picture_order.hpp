#pragma once

#include <cstdint>

#include "head/core/camera/frame_notice.hpp"
#include "head/core/camera/head_model.hpp"

namespace priamos::head {

/// Which picture of the third camera was ordered last, and whether it is still awaited. Each purpose has
/// numbers of its own, from `first` on; looks count from 1.
class PictureOrder {
 public:
  explicit PictureOrder(std::int32_t first) : first_(first) {}

  /// Orders the next one, as frame_id().
  void Order() {
    constexpr std::int32_t kNumbers = 0x10000;
    frame_id_ = frame_id_ == 0 || frame_id_ == first_ + kNumbers - 1 ? first_ : frame_id_ + 1;
    awaited_ = true;
  }
  /// It is of no use any more.
  void Drop() { awaited_ = false; }
  bool awaited() const { return awaited_; }
  /// Whether this is the picture that is awaited; true once.
  bool Takes(const FrameNotice& frame) {
    if (!awaited_ || frame.frame_id != frame_id_ || frame.camera != kThird) return false;
    awaited_ = false;
    return true;
  }
  std::int32_t frame_id() const { return frame_id_; }

 private:
  std::int32_t first_, frame_id_ = 0;
  bool awaited_ = false;
};

}  // namespace priamos::head
