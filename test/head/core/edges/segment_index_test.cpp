#include "head/core/edges/segment_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/random.hpp"

namespace priamos::head {
namespace {

struct Segment {
  Eigen::Vector2d begin, end;

  double DistanceTo(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d delta = end - begin;
    const double f = std::clamp(delta.dot(p - begin) / std::max(delta.squaredNorm(), 1e-9), 0.0, 1.0);
    return (begin + f * delta - p).norm();
  }
};

class SegmentIndexTest : public testing::Test {
 protected:
  SegmentIndexTest() {
    Rng rng(1);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d begin(rng.Uniform(-5, 773), rng.Uniform(-5, 581));
      segments_.push_back({begin, begin + Eigen::Vector2d(rng.Normal(60), rng.Normal(60))});
      dut_.Insert(i, segments_.back().begin, segments_.back().end);
    }
  }
  SegmentIndex dut_{768, 576, 32};
  std::vector<Segment> segments_;
};

TEST_F(SegmentIndexTest, MissesNothingNearAPoint) {
  Rng rng(2);
  for (int run = 0; run < 200; ++run) {
    const Eigen::Vector2d at(rng.Uniform(0, 768), rng.Uniform(0, 576));
    const double reach = rng.Uniform(1, 50);
    std::vector<int> found;
    dut_.Near(at, reach, found);
    for (int i = 0; i < 200; ++i) {
      if (segments_[i].DistanceTo(at) > reach) continue;
      EXPECT_NE(std::find(found.begin(), found.end(), i), found.end());
    }
  }
}

TEST_F(SegmentIndexTest, MissesNothingAlongASegment) {
  for (int k = 0; k < 50; ++k) {
    const Segment& delta = segments_[k];
    std::vector<int> found;
    dut_.Along(delta.begin, delta.end, 10, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (int i = 0; i < 200; ++i) {
      bool near = false;
      for (double f = 0; f <= 1; f += 0.01)
        near = near || segments_[i].DistanceTo(delta.begin + f * (delta.end - delta.begin)) <= 10;
      if (near) {
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i));
      }
    }
  }
}

TEST_F(SegmentIndexTest, LooksOnlyAtWhatIsNear) {
  std::vector<int> found;
  dut_.Near({100, 100}, 5, found);
  EXPECT_LT(found.size(), 60u);
}

}  // namespace
}  // namespace priamos::head
