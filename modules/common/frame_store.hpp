#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace priamos {

/// A grey image outside any library: row by row, `width` bytes a row.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// The frame grabber's memory: a ring of image slots in shared memory (/dev/shm), written by the camera
/// side and read by `head`. Images never travel on a bus; a camera_frame_t names the slot of each.
class FrameStore {
 public:
  static constexpr int kSlots = 8;
  static constexpr std::size_t kSlotBytes = 1 << 20;

  /// Creates the store, replacing one left behind by a dead process; removes it when destroyed, unless
  /// another has taken its place by then.
  static FrameStore Create(const std::string& name);
  /// Attaches for reading; nullopt while nobody has created it.
  static std::optional<FrameStore> Attach(const std::string& name);

  FrameStore(FrameStore&& other) noexcept;
  FrameStore& operator=(FrameStore&& other) noexcept;
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;
  ~FrameStore();

  /// Stores an image of at most kSlotBytes under `frame_id` and returns its slot; the oldest image is
  /// overwritten. Throws std::invalid_argument for an image that does not fit.
  int Write(std::int32_t frame_id, const GreyImage& image);

  /// The image in `slot`; nullopt if the slot does not hold `frame_id` (any more) or its header is not
  /// credible.
  std::optional<GreyImage> Read(int slot, std::int32_t frame_id) const;

 private:
  struct Slot;
  FrameStore(std::string name, void* memory, ino_t owned);
  Slot* slot(int index) const;

  std::string name_;
  void* memory_ = nullptr;
  ino_t owned_ = 0;  ///< the memory this one has created; 0: attached
  int next_ = 0;
};

}  // namespace priamos
