#include "console/core/news.hpp"

#include <gmock/gmock.h>

namespace priamos::console {
namespace {

using testing::ElementsAre;

std::vector<std::string> KeysSince(const News& news, std::uint64_t number) {
  std::vector<std::string> keys;
  for (const News::Item* item : news.Since(number)) keys.push_back(item->key);
  return keys;
}

TEST(News, APageGetsWhatIsNewerThanWhatItKnows) {
  News dut;
  dut.Put("POSE", "POSE", {}, {{"x_m", 1}});
  dut.Put("PATH", "PATH", {}, {});
  const auto known = dut.newest();
  EXPECT_THAT(KeysSince(dut, 0), ElementsAre("POSE", "PATH"));
  EXPECT_THAT(KeysSince(dut, known), ElementsAre());
  dut.Put("POSE", "POSE", {}, {{"x_m", 2}});
  EXPECT_THAT(KeysSince(dut, known), ElementsAre("POSE"));
  EXPECT_EQ(dut.Since(known)[0]->message["x_m"], 2);
  EXPECT_THAT(KeysSince(dut, 0), ElementsAre("PATH", "POSE")) << "each once, the newest";
}

TEST(News, KeysAreBoundedWhateverAnybodySends) {
  News dut;
  for (int i = 0; i < 2000; ++i) dut.Put("HEALTH " + std::to_string(i), "HEALTH", {}, {});
  EXPECT_EQ(dut.Since(0).size(), News::kMostKeys);
  dut.Put("HEALTH 3", "HEALTH", {}, {{"state", 1}});
  EXPECT_EQ(dut.Since(dut.newest() - 1)[0]->key, "HEALTH 3") << "known ones go on";
}

TEST(News, MessagesThatDoNotReplaceEachOtherHaveKeysOfTheirOwn) {
  EXPECT_EQ(KeyOf("POSE", {{"utime", 3}}, 5), "POSE");
  EXPECT_NE(KeyOf("HEALTH", {{"process", "robot"}}, 0), KeyOf("HEALTH", {{"process", "head"}}, 0));
  EXPECT_NE(KeyOf("PROCESS_STATE", {{"process", "line"}}, 0), KeyOf("PROCESS_STATE", {{"process", "x"}}, 0));
  EXPECT_NE(KeyOf("PROCESS_REPORT", {{"name", "line"}}, 0), KeyOf("PROCESS_REPORT", {{"name", "door"}}, 0));
  EXPECT_NE(KeyOf("LINK_STATUS", {{"onboard", true}, {"first_channel", 0}}, 0),
            KeyOf("LINK_STATUS", {{"onboard", false}, {"first_channel", 0}}, 0));
  EXPECT_NE(KeyOf("ALARM", {}, 0), KeyOf("ALARM", {}, 1));
  EXPECT_NE(KeyOf("ALARM_ACK", {}, 0), KeyOf("ALARM_ACK", {}, 1));
  EXPECT_NE(KeyOf("DOOR_SEEN", {{"landmark_id", 1}}, 0), KeyOf("DOOR_SEEN", {{"landmark_id", 2}}, 0));
  EXPECT_NE(KeyOf("DOOR_FOUND", {{"id", 1}}, 0), KeyOf("DOOR_FOUND", {{"id", 2}}, 0));
  EXPECT_NE(KeyOf("SCENE_OBJECT", {{"id", 1}}, 0), KeyOf("SCENE_OBJECT", {{"id", 2}}, 0));
  EXPECT_EQ(KeyOf("HEALTH", {}, 0), "HEALTH ") << "a field that lacks is none";
}

}  // namespace
}  // namespace priamos::console
