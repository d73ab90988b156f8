#include "head/core/doors/outline_evidence.hpp"

#include <gtest/gtest.h>

#include "head/core/stand/camera_stand.hpp"
#include "test/head/exact_view.hpp"

namespace priamos::head {
namespace {

constexpr double kCamera_m = 1.2, kLintel_m = 2.05;

/// A framed door 4 m ahead, as a level camera sees it; origin at the camera.
class OutlineEvidenceTest : public testing::Test {
 protected:
  static CameraModel Level() {
    CameraModel camera;
    camera.image_from_base << 500, 0, 384, 0, 0, 500, 288, 0, 0, 0, 1, 0;
    return OnTheFloor(camera, {});
  }
  OutlineEvidenceTest() {
    for (const double inner : {0.0, 0.06}) {
      for (const double y : {0.45 - inner, -0.45 + inner}) See(y, kLintel_m - inner, y, foot_m_);
      See(0.45 - inner, kLintel_m - inner, -0.45 + inner, kLintel_m - inner);
    }
  }
  void See(double y0, double z0, double y1, double z1) {
    scene_.See({4, y0, z0 - kCamera_m}, {4, y1, z1 - kCamera_m});
  }
  /// The outer outline.
  double LogOdds(double camera_m = kCamera_m, double lintel_m = kLintel_m) {
    const CameraView view = scene_.View();
    const OutlineWeigher weigher(view);
    double best = -100;
    for (const DoorOutline& outline : FindOutlines(view, {})) {
      if (std::abs((kLintel_m - kCamera_m) * outline.width() - 0.9) > 0.02) continue;
      const OutlineEvidence evidence = weigher.Weigh(outline);
      best = std::max(best, OutlineLogOdds(outline, evidence, camera_m, lintel_m));
    }
    return best;
  }

  double foot_m_ = 0;
  test::ExactView scene_{Level()};
};

TEST_F(OutlineEvidenceTest, AFramedDoorIsLikely) {
  EXPECT_GT(LogOdds(), 1);
}

TEST_F(OutlineEvidenceTest, WhoseFeetHangOrAreBelowTheFloorIsLessSo) {
  EXPECT_LT(LogOdds(1.7, 2.55), LogOdds()) << "it would hang";
  EXPECT_LT(LogOdds(0.9, 1.75), LogOdds()) << "it would go on below the floor";
}

TEST_F(OutlineEvidenceTest, SkirtingBesideTheFeetSpeaksForIt) {
  const double before = LogOdds();
  See(1.4, 0, 0.5, 0);
  EXPECT_GT(LogOdds(), before);
}

TEST_F(OutlineEvidenceTest, ALevelBorderAboveTheFloorSpeaksAgainstIt) {
  const double before = LogOdds();
  See(0.45, 0.5, -0.45, 0.5);
  EXPECT_LT(LogOdds(), before);
}

TEST_F(OutlineEvidenceTest, TheTopOfABoxSpeaksAgainstIt) {
  const double before = LogOdds();
  scene_.See({4, -0.45, kLintel_m - kCamera_m}, {5, -0.80, kLintel_m - kCamera_m});
  EXPECT_LT(LogOdds(), before);
}

}  // namespace
}  // namespace priamos::head
