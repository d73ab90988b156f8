#include "head/images/exif_orientation.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace priamos::head {
namespace {

std::vector<std::uint8_t> Block(bool little, std::uint8_t orientation) {
  if (little) return {'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 1, 3, 0, 1, 0, 0, 0, orientation, 0, 0, 0};
  return {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0, 3, 0, 0, 0, 1, 0, orientation, 0, 0};
}

TEST(ExifOrientation, IsReadInBothOrdersOfBytes) {
  for (const bool little : {false, true})
    for (std::uint8_t orientation = 1; orientation <= 8; ++orientation)
      EXPECT_EQ(ExifOrientation(Block(little, orientation)), orientation);
}

TEST(ExifOrientation, ABlockThatSaysNothingMeansUpright) {
  for (const std::uint8_t orientation : {0, 9, 255}) EXPECT_EQ(ExifOrientation(Block(true, orientation)), 1);
  EXPECT_EQ(ExifOrientation({}), 1);
  const auto whole = Block(false, 6);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(ExifOrientation(FileBytes(whole).first(size)), 1) << size;
}

TEST(ExifOrientation, ADirectoryOutsideTheBlockIsNotFollowed) {
  auto block = Block(true, 6);
  for (const std::uint8_t at : {15, 22, 255}) {
    block[4] = block[5] = block[6] = block[7] = at;
    EXPECT_EQ(ExifOrientation(block), 1);
  }
}

}  // namespace
}  // namespace priamos::head
