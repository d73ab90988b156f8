#include "head/picture_source.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "head/head_app.hpp"
#include "test/head/head_on_a_bench.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;
using Bench = HeadOnABench<HeadApp>;

constexpr int kLeftAndRight = 3;  // bits of a trigger

HeadConfig Keeping(const std::string& folder) {
  HeadConfig config;
  config.keep_pictures = folder;
  return config;
}
HeadConfig SeeingIn(const std::string& folder) {
  HeadConfig config;
  config.pictures = folder;
  return config;
}
std::size_t FilesIn(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(PictureSource, KeepsThePicturesThatItUses) {
  const TemporaryFolder folder;
  Bench head(Keeping(folder / "kept"));
  head.SendBoard(3, 2.5, 0);
  for (const int request : {7, 8}) {
    head.SendLook(request, 3);
    head.Run(1);
  }
  EXPECT_EQ(FilesIn(folder / "kept"), 4U);
  EXPECT_EQ(head.context.health(), bus::Health::kOk);
}

TEST(PictureSource, APictureThatCannotBeKeptIsCounted) {
  Bench head(Keeping("/dev/null/kept"));
  head.SendBoard(3, 2.5, 0);
  head.SendLook(7, 3);
  head.Run(1);
  EXPECT_EQ(head.context.health(), bus::Health::kDegraded);
  EXPECT_EQ(head.context.health_text(), "2 pictures could not be kept");
  EXPECT_TRUE(head.Logged("/dev/null/kept"));
  EXPECT_EQ(head.fixes.Drain().size(), 1U) << "the look is answered all the same";
}

TEST(PictureSource, OnALogItExposesNothingAndSeesInTheFolder) {
  const TemporaryFolder folder;
  Bench head(SeeingIn(folder.path()));
  head.SendBoard(3, 2.5, 0);
  head.position_known = true;
  head.motors_obey = false;  // where the head points is the log's
  head.SendLook(7, 3);
  head.Run(0.5);
  EXPECT_TRUE(head.triggers.empty());
  const Time exposure = head.clock.Now();
  for (const int camera : {kLeft, kRight})
    ASSERT_EQ(PictureFolder(folder.path()).Keep({exposure, 5, camera, 0, 768, 576}, head.picture),
              std::nullopt);
  head.Expose([] {
    camera_trigger_t recorded{};
    recorded.frame_id = 5;
    recorded.cameras = kLeftAndRight;
    return recorded;
  }());
  head.Run(0.1);
  const auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1U);
  EXPECT_EQ(fixes[0].utime_exposure, ToUtime(exposure));
  EXPECT_FALSE(head.Logged("not in the folder"));
}

TEST(PictureSource, OnALogALookWhosePicturesAreLostEndsWithTheNextOne) {
  const TemporaryFolder folder;
  Bench head(SeeingIn(folder.path()));
  camera_trigger_t recorded{};
  recorded.frame_id = 5;
  recorded.cameras = kLeftAndRight;
  head.SendLook(7, 3);
  head.Run(0.5);
  head.Expose(recorded);
  head.Run(1);
  EXPECT_TRUE(head.fixes.Drain().empty());
  head.SendLook(8, 3);
  head.Run(0.1);
  const auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1U);
  EXPECT_EQ(fixes[0].request_id, 7);
  EXPECT_EQ(fixes[0].verdict, landmark_fix_t::NO_IMAGE);
}

TEST(PictureSource, AFolderOfPicturesThatIsNoneIsRefused) {
  EXPECT_THAT(support::ThrownReason([] { Bench(SeeingIn("/nowhere/pictures")); }),
              HasSubstr("pictures: expected a folder with the pictures of a log, got /nowhere/pictures"));
}

}  // namespace
}  // namespace priamos::head
