#include "console/video_feed.hpp"

#include <gmock/gmock.h>

#include <bit>

namespace priamos::console {
namespace {

TEST(CameraOfTest, NamesTheRobotAndAsksWithAViewersTokenWhereThereIsOne) {
  const PictureAddress server{"10.0.0.1", "8081", "10.0.0.1:8081", ""};
  const TokenHolder driver{Role::kDriver, "driverdriverdriver", "anna"};
  const TokenHolder viewer{Role::kViewer, "viewerviewerviewer"};
  EXPECT_EQ(CameraOf(server, "priamos", {}).target, "/priamos/third.jpg");
  EXPECT_EQ(CameraOf(server, "priamos", {driver, viewer}).target,
            "/priamos/third.jpg?token=viewerviewerviewer");
  EXPECT_EQ(CameraOf(server, "other", {driver}).target, "/other/third.jpg?token=driverdriverdriver");
  EXPECT_EQ(CameraOf(server, "other", {driver}).authority, "10.0.0.1:8081");
}

TEST(PagePictureTest, IsTheAgeAndTheJpeg) {
  const Time now{std::chrono::seconds(100)};
  const std::string message = PagePicture({"JPEG", now - FromSeconds(0.25)}, now);
  ASSERT_EQ(message.size(), 12u);
  EXPECT_EQ(message.substr(8), "JPEG");
  std::uint64_t bits = 0;
  for (int i = 0; i < 8; ++i)
    bits = bits << 8 | static_cast<unsigned char>(message[static_cast<std::size_t>(i)]);
  EXPECT_DOUBLE_EQ(std::bit_cast<double>(bits), 0.25);
}

}  // namespace
}  // namespace priamos::console
