#include "head/core/tracks/track_list.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

struct Track {
  int id = 0;
  int seen = 0;
};

TEST(TrackList, EachHasANumberAndTheOldestGoes) {
  std::vector<Track> tracks;
  int last_id = 254;
  BeginTrack(Track{0, 5}, 2, last_id, tracks);
  BeginTrack(Track{0, 3}, 2, last_id, tracks);
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].id, 255);
  EXPECT_EQ(tracks[1].id, 0) << "numbers go round";
  BeginTrack(Track{0, 9}, 2, last_id, tracks);
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].seen, 5);
  EXPECT_EQ(tracks[1].seen, 9);
}

}  // namespace
}  // namespace priamos::head
