#include "head/picture_folder.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

/// A notice of a picture and the picture.
class PictureFolderTest : public testing::Test {
 protected:
  static GreyImage Noise() {
    GreyImage image{96, 64, {}};
    for (int i = 0; i < image.width * image.height; ++i)
      image.pixels.push_back(static_cast<std::uint8_t>(i * 37));
    return image;
  }
  std::string FileOfNotice() const { return folder_ / "pictures/1700000000123456-right.pgm"; }

  const TemporaryFolder folder_;
  const FrameNotice notice_{FromUtime(1'700'000'000'123'456), 7, 1, 3, 96, 64};
  PictureFolder dut_{folder_ / "pictures"};
};

TEST_F(PictureFolderTest, GivesBackWhatItKept) {
  EXPECT_FALSE(dut_.Has(notice_));
  EXPECT_EQ(dut_.Keep(notice_, Noise()), std::nullopt);
  EXPECT_TRUE(dut_.Has(notice_));
  EXPECT_TRUE(std::filesystem::exists(FileOfNotice()));
  const auto image = dut_.Read(notice_);
  ASSERT_TRUE(image) << image.reason();
  EXPECT_EQ(image->width, 96);
  EXPECT_EQ(image->pixels, Noise().pixels);
}

TEST_F(PictureFolderTest, SaysWhyThereIsNone) {
  EXPECT_THAT(dut_.Read(notice_).reason(), HasSubstr(FileOfNotice()));
  ASSERT_EQ(dut_.Keep(notice_, Noise()), std::nullopt);
  std::filesystem::resize_file(FileOfNotice(), 1000);
  EXPECT_THAT(dut_.Read(notice_).reason(), HasSubstr(FileOfNotice()));
  FrameNotice other = notice_;
  other.height = 63;
  ASSERT_EQ(dut_.Keep(notice_, Noise()), std::nullopt);
  EXPECT_THAT(dut_.Read(other).reason(),
              HasSubstr("expected 96 x 63 pixels as its message says, got 96 x 64"));
}

TEST_F(PictureFolderTest, SaysWhyItCannotKeepOne) {
  std::ofstream(folder_ / "pictures") << "a file, no folder";
  const auto refusal = dut_.Keep(notice_, Noise());
  ASSERT_TRUE(refusal);
  EXPECT_THAT(refusal->reason, HasSubstr("cannot be"));
}

TEST_F(PictureFolderTest, ACameraThatDoesNotExistLeadsToNoOtherFile) {
  FrameNotice hostile = notice_;
  for (const int camera : {-100, 99}) {
    hostile.camera = camera;
    EXPECT_FALSE(dut_.Has(hostile));
  }
}

}  // namespace
}  // namespace priamos::head
