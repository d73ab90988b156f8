#include "head/images/exif_orientation.hpp"

namespace priamos::head {
namespace {

constexpr int kOrientationTag = 0x0112, kShort = 3, kUpright = 1;
constexpr std::size_t kEntryBytes = 12;

/// Numbers of a block in its own order of bytes; 0 beyond its end.
class Reader {
 public:
  explicit Reader(FileBytes block) : block_(block), little_(block.size() > 1 && block[0] == 'I') {}

  bool is_tiff() const {
    const bool order = block_.size() >= 8 && block_[0] == block_[1] && (block_[0] == 'I' || block_[0] == 'M');
    return order && Short(2) == 42;
  }
  unsigned Short(std::size_t at) const {
    if (at + 2 > block_.size()) return 0;
    const unsigned first = block_[at], second = block_[at + 1];
    return little_ ? first | second << 8 : first << 8 | second;
  }
  std::size_t Long(std::size_t at) const {
    const std::size_t first = Short(at), second = Short(at + 2);
    return little_ ? first | second << 16 : first << 16 | second;
  }

 private:
  FileBytes block_;
  bool little_;
};

}  // namespace

int ExifOrientation(FileBytes exif) {
  const Reader reader(exif);
  if (!reader.is_tiff()) return kUpright;
  const std::size_t directory = reader.Long(4), entries = reader.Short(directory);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntryBytes;
    if (entry + kEntryBytes > exif.size()) return kUpright;
    if (reader.Short(entry) != kOrientationTag || reader.Short(entry + 2) != kShort) continue;
    const unsigned orientation = reader.Short(entry + 8);
    return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : kUpright;
  }
  return kUpright;
}

}  // namespace priamos::head
