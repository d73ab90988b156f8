#include "head/camera_reader.hpp"

namespace priamos::head {

std::optional<GreyImage> CameraReader::Read(const FrameNotice& frame) {
  // A camera process that was restarted has made a new store under the old name: attach once more.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!store_) store_ = FrameStore::Attach(store_name_);
    if (!store_) return std::nullopt;
    auto image = store_->Read(frame.slot, frame.frame_id);
    if (image && image->width == frame.width && image->height == frame.height) return image;
    store_.reset();
  }
  return std::nullopt;
}

}  // namespace priamos::head
