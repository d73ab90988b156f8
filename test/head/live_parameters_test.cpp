// Every parameter of the head that may be changed while it runs has its effect at once: a head that was told
// of a value behaves like one that was started with it, and unlike one that was not.

#include "test/support/parameters/live_parameters.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "head/head_app.hpp"
#include "test/head/head_on_a_bench.hpp"

namespace priamos::head {
namespace {

using Bench = HeadOnABench<HeadApp>;
using Measure = std::function<double(Bench&)>;

/// An upright board of 0.8 m at (2.5 m, y_m) whose edges belong to its left and its right side.
landmark_model_t Board(double y_m) {
  landmark_model_t model{};
  model.landmark_id = 3;
  model.x_m = 2.5;
  model.y_m = y_m;
  for (const int side : {1, 2}) {
    landmark_edge_t edge{};
    edge.y1_m = edge.y2_m = side == 1 ? 0.4 : -0.4;
    edge.z2_m = 2;
    edge.visible_from_rad = -3.14;
    edge.visible_to_rad = 3.14;
    edge.side = static_cast<std::int8_t>(side);
    model.edges.push_back(edge);
  }
  model.n_edges = 2;
  return model;
}

/// Where the head turns for a look at the left side of a board that is `y_m` to the left, while the base
/// drives.
Measure PanTo(double y_m) {
  return [=](Bench& head) {
    head.models.Publish(Board(y_m));
    for (int i = 0; i < 50; ++i) {
      pose_t pose{};
      pose.utime = ToUtime(head.clock.Now());
      pose.x_m = 0.008 * i;
      pose.vx_m_s = 0.4;
      pose.sigma_x_m = pose.sigma_y_m = 0.01;
      pose.sigma_yaw_rad = 0.005;
      head.poses.Publish(pose);
      if (i == 5) {
        look_request_t look{};
        look.utime = ToUtime(head.clock.Now());
        look.request_id = 8;
        look.landmark_id = 3;
        look.side = 1;
        head.looks.Publish(look);
      }
      head.Step();
    }
    return head.commands.empty() ? -9 : head.commands.back().pan_rad;
  };
}

double Exposures(Bench& head) {
  head.cameras_answer = false;
  head.SendLook(7, 3);
  head.Run(1.2);
  return static_cast<double>(head.triggers.size());
}

double ExposuresSoon(Bench& head) {
  head.SendLook(7, 3);
  head.Run(0.6);
  return static_cast<double>(head.triggers.size());
}

double AnswersWithoutPictures(Bench& head) {
  head.cameras_answer = false;
  head.SendLook(7, 3);
  head.Run(1.2);
  return static_cast<double>(head.fixes.Drain().size());
}

double AnswersWithoutMotors(Bench& head) {
  head.motors_obey = false;
  head.SendLook(7, 3);
  head.Run(1.2);
  return static_cast<double>(head.fixes.Drain().size());
}

struct Story {
  double value;  ///< another one than the default
  Measure measure;
};

const std::map<std::string, Story> kStories{
    {"aim.side_share", {0, PanTo(0)}},
    {"aim.lead_s", {3, PanTo(1.5)}},
    {"aim.max_pan_deg", {20, PanTo(2)}},
    {"look.frame_timeout_s", {5, Exposures}},
    {"look.age_limit_s", {0.5, AnswersWithoutPictures}},
    {"motors.settle_s", {2, ExposuresSoon}},
    {"motors.timeout_s", {0.5, AnswersWithoutMotors}},
};

double Measured(const Story& story, const HeadConfig& started, const HeadConfig& told) {
  Bench head(started);
  HeadConfig config = told;
  config.calibration = head.folder / "kastor.yaml";
  head.dut->Reconfigure(config);
  return story.measure(head);
}

TEST(LiveParametersOfTheHead, EachHasItsStory) {
  ExpectAStoryForEach<HeadConfig>(kStories);
}

class LiveParameterOfTheHeadTest : public testing::TestWithParam<std::string> {};

TEST_P(LiveParameterOfTheHeadTest, IsObeyedAtOnceAsIfTheHeadHadBeenStartedWithIt) {
  const Story& story = kStories.at(GetParam());
  ExpectObeyedAtOnce<HeadConfig>(
      GetParam(), story.value,
      [&](const HeadConfig& started, const HeadConfig& given) { return Measured(story, started, given); });
}

INSTANTIATE_TEST_SUITE_P(All, LiveParameterOfTheHeadTest, testing::ValuesIn(NamesOf(kStories)),
                         ParameterTestName);

}  // namespace
}  // namespace priamos::head
