#pragma once

#include <optional>
#include <string>

#include "common/frame_store.hpp"
#include "head/core/camera/frame_notice.hpp"

namespace priamos::head {

/// Fetches pictures from the frame grabber's memory.
class CameraReader {
 public:
  explicit CameraReader(std::string store_name) : store_name_(std::move(store_name)) {}

  /// Picture that a notice names; nullopt if it is not there (any more) or not the one that the notice names.
  std::optional<GreyImage> Read(const FrameNotice& frame);

 private:
  std::string store_name_;
  std::optional<FrameStore> store_;
};

}  // namespace priamos::head
