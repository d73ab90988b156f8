#include "common/frame_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace priamos {

/// Sequence lock: odd while being written, so that a reader notices an image torn under its hands.
struct FrameStore::Slot {
  std::atomic<std::uint32_t> sequence;
  std::int32_t frame_id;
  std::int32_t width, height;
  std::uint8_t pixels[kSlotBytes];
};

namespace {
std::string ShmName(const std::string& name) {
  return "/priamos-" + name;
}

/// Inode of the shared memory: a later one of the same name has another. 0 when there is none.
ino_t InodeOf(const std::string& path) {
  const int fd = shm_open(path.c_str(), O_RDONLY | O_CLOEXEC, 0);
  if (fd < 0) return 0;
  struct stat info {};
  const bool known = fstat(fd, &info) == 0;
  close(fd);
  return known ? info.st_ino : 0;
}
}  // namespace

FrameStore::FrameStore(std::string name, void* memory, ino_t owned)
    : name_(std::move(name)), memory_(memory), owned_(owned) {}

FrameStore FrameStore::Create(const std::string& name) {
  const std::string path = ShmName(name);
  shm_unlink(path.c_str());
  const int fd = shm_open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), "frame store " + path);
  const std::size_t bytes = sizeof(Slot) * kSlots;
  void* memory = MAP_FAILED;
  if (ftruncate(fd, static_cast<off_t>(bytes)) == 0)
    memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  const int error = errno;
  close(fd);
  if (memory == MAP_FAILED) throw std::system_error(error, std::generic_category(), "frame store " + path);
  return FrameStore(name, memory, InodeOf(path));
}

std::optional<FrameStore> FrameStore::Attach(const std::string& name) {
  const int fd = shm_open(ShmName(name).c_str(), O_RDONLY | O_CLOEXEC, 0);
  if (fd < 0) return std::nullopt;
  struct stat info {};
  const std::size_t bytes = sizeof(Slot) * kSlots;
  void* memory = MAP_FAILED;
  if (fstat(fd, &info) == 0 && info.st_size == static_cast<off_t>(bytes))
    memory = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, fd, 0);
  close(fd);
  if (memory == MAP_FAILED) return std::nullopt;
  return FrameStore(name, memory, 0);
}

FrameStore::FrameStore(FrameStore&& other) noexcept
    : name_(std::move(other.name_)),
      memory_(std::exchange(other.memory_, nullptr)),
      owned_(std::exchange(other.owned_, 0)),
      next_(other.next_) {}

FrameStore& FrameStore::operator=(FrameStore&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(memory_, other.memory_);
  std::swap(owned_, other.owned_);
  std::swap(next_, other.next_);
  return *this;
}

FrameStore::~FrameStore() {
  if (memory_) munmap(memory_, sizeof(Slot) * kSlots);
  if (owned_ != 0 && InodeOf(ShmName(name_)) == owned_) shm_unlink(ShmName(name_).c_str());
}

FrameStore::Slot* FrameStore::slot(int index) const {
  return static_cast<Slot*>(memory_) + index;
}

int FrameStore::Write(std::int32_t frame_id, const GreyImage& image) {
  const bool fits = image.width > 0 && image.height > 0 && image.pixels.size() <= kSlotBytes &&
                    image.pixels.size() == static_cast<std::size_t>(image.width) * image.height;
  if (owned_ == 0 || !fits)
    throw std::invalid_argument(
        fmt::format("frame store {}: cannot hold {}x{}", name_, image.width, image.height));
  const int index = std::exchange(next_, (next_ + 1) % kSlots);
  Slot& s = *slot(index);
  s.sequence.fetch_add(1, std::memory_order_acq_rel);
  s.frame_id = frame_id;
  s.width = image.width;
  s.height = image.height;
  std::memcpy(s.pixels, image.pixels.data(), image.pixels.size());
  s.sequence.fetch_add(1, std::memory_order_release);
  return index;
}

std::optional<GreyImage> FrameStore::Read(int index, std::int32_t frame_id) const {
  if (index < 0 || index >= kSlots) return std::nullopt;
  const Slot& s = *slot(index);
  const auto before = s.sequence.load(std::memory_order_acquire);
  GreyImage image{s.width, s.height, {}};
  const bool credible = before % 2 == 0 && s.frame_id == frame_id && image.width > 0 && image.height > 0 &&
                        image.width <= 4096 && image.height <= 4096 &&
                        static_cast<std::size_t>(image.width) * image.height <= kSlotBytes;
  if (!credible) return std::nullopt;
  image.pixels.assign(s.pixels, s.pixels + static_cast<std::size_t>(image.width) * image.height);
  std::atomic_thread_fence(std::memory_order_acquire);
  if (s.sequence.load(std::memory_order_relaxed) != before) return std::nullopt;
  return image;
}

}  // namespace priamos
