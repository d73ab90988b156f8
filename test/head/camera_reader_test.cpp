#include "head/camera_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace priamos::head {
namespace {

class CameraReaderTest : public testing::Test {
 protected:
  static GreyImage Image(int width, int height, int grey) {
    return {width, height,
            std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, std::uint8_t(grey))};
  }
  /// Puts an image into the store and says where.
  static FrameNotice Put(FrameStore& store, int frame_id, const GreyImage& image) {
    return {.exposure = {},
            .frame_id = frame_id,
            .camera = 0,
            .slot = store.Write(frame_id, image),
            .width = image.width,
            .height = image.height};
  }

  /// Tests run side by side, each in its process.
  const std::string name_ = fmt::format("priamos-test-reader-{}", getpid());
  CameraReader dut_{name_};
};

TEST_F(CameraReaderTest, ReadsThePictureOfTheNotice) {
  FrameStore store = FrameStore::Create(name_);
  const FrameNotice first = Put(store, 1, Image(64, 48, 10)), second = Put(store, 2, Image(64, 48, 20));
  for (const auto& [notice, grey] : {std::pair(second, 20), std::pair(first, 10)}) {
    const auto image = dut_.Read(notice);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 64);
    EXPECT_EQ(image->height, 48);
    EXPECT_EQ(image->pixels, Image(64, 48, grey).pixels);
  }
}

TEST_F(CameraReaderTest, BeforeThereIsACameraThereIsNoPicture) {
  FrameNotice notice{.exposure = {}, .frame_id = 1, .width = 64, .height = 48};
  EXPECT_FALSE(dut_.Read(notice));
  FrameStore store = FrameStore::Create(name_);
  EXPECT_TRUE(dut_.Read(Put(store, 1, Image(64, 48, 10)))) << "but as soon as there is one";
}

TEST_F(CameraReaderTest, APictureThatIsNotThereAnyMoreIsNone) {
  FrameStore store = FrameStore::Create(name_);
  const FrameNotice first = Put(store, 1, Image(64, 48, 10));
  for (int i = 0; i < FrameStore::kSlots; ++i) Put(store, 2 + i, Image(64, 48, 20));
  EXPECT_FALSE(dut_.Read(first));
}

TEST_F(CameraReaderTest, APictureOfAnotherSizeThanTheNoticeSaysIsNone) {
  FrameStore store = FrameStore::Create(name_);
  FrameNotice notice = Put(store, 1, Image(64, 48, 10));
  notice.width = 48;
  notice.height = 64;
  EXPECT_FALSE(dut_.Read(notice));
  notice.width = 64;
  notice.height = 48;
  EXPECT_TRUE(dut_.Read(notice));
}

TEST_F(CameraReaderTest, ASlotThatDoesNotExistHoldsNoPicture) {
  FrameStore store = FrameStore::Create(name_);
  FrameNotice notice = Put(store, 1, Image(64, 48, 10));
  for (const int slot : {-1, FrameStore::kSlots, 1000}) {
    notice.slot = slot;
    EXPECT_FALSE(dut_.Read(notice)) << slot;
  }
}

TEST_F(CameraReaderTest, ACameraThatWasRestartedIsFoundAgain) {
  {
    FrameStore store = FrameStore::Create(name_);
    ASSERT_TRUE(dut_.Read(Put(store, 1, Image(64, 48, 10))));
  }
  FrameStore store = FrameStore::Create(name_);
  const auto image = dut_.Read(Put(store, 1, Image(64, 48, 30)));
  // The old memory still holds a picture of this number; either is what the notice says, but the next is new.
  ASSERT_TRUE(image);
  const auto next = dut_.Read(Put(store, 2, Image(64, 48, 40)));
  ASSERT_TRUE(next);
  EXPECT_EQ(next->pixels[0], 40);
}

}  // namespace
}  // namespace priamos::head
