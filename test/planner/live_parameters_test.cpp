// Every parameter of the planner that may be changed while it runs has its effect on the next order: a
// planner that was told of a value behaves like one that was started with it, and unlike one that was not.

#include "test/support/parameters/live_parameters.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "test/planner/workstation.hpp"

namespace priamos::planner {
namespace {

using Measure = std::function<double(Workstation&)>;

/// The path that an order leads to, of a robot at x.
path_t PathOf(Workstation& w, std::int8_t mission, double x_m) {
  mission_command_t order{};
  order.utime = ToUtime(w.clock.Now());
  order.mission = mission;
  order.landmark_id = 1;
  order.x_m = x_m + 1;
  order.y_m = 2.4;
  order.distance_m = 4;
  w.order.Publish(order);
  w.SendLink(true);
  w.SendPose(x_m);
  w.Run(2);
  const auto paths = w.paths.Drain();
  return paths.empty() ? path_t{} : paths.front();
}

Measure SpeedOf(std::int8_t mission) {
  return [=](Workstation& w) { return PathOf(w, mission, 3.1).speed_m_s; };
}

double LeewayInACorridor(Workstation& w) {
  const path_t path = PathOf(w, mission_command_t::CORRIDOR, 3);
  return path.points.empty() ? -1 : path.points.front().left_m;
}

double LooksFarFromTheDoor(Workstation& w) {
  PathOf(w, mission_command_t::PASS_DOOR, 2.2);
  w.SendPose(2.3, 0.3);
  w.Run(2);
  return static_cast<double>(w.looks.Drain().size());
}

/// The phase of a mission whose robot makes no progress for 5 s.
double PhaseOfARobotThatIsHeld(Workstation& w) {
  const path_t path = PathOf(w, mission_command_t::GOTO, 3.1);
  for (int i = 0; i < 25; ++i) {
    w.SendPose(3.1);
    drive_status_t drive{};
    drive.utime = ToUtime(w.clock.Now());
    drive.path_id = path.path_id;
    drive.mode = drive_status_t::FOLLOWING;
    drive.limit = drive_status_t::LIMIT_POSE_STALE;
    drive.remaining_m = 1;
    w.drive.Publish(drive);
    w.Run(4);
  }
  return w.phase();
}

struct Story {
  double value;  ///< another one than the default
  Measure measure;
};

const std::map<std::string, Story> kStories{
    {"mission.speed_m_s", {0.2, SpeedOf(mission_command_t::PASS_DOOR)}},
    {"mission.look_from_m", {5, LooksFarFromTheDoor}},
    {"mission.look_to_m", {1.5, SpeedOf(mission_command_t::PASS_DOOR)}},
    {"goto.speed_m_s", {0.1, SpeedOf(mission_command_t::GOTO)}},
    {"goto.stands_s", {2, PhaseOfARobotThatIsHeld}},
    {"corridor.speed_m_s", {0.1, SpeedOf(mission_command_t::CORRIDOR)}},
    {"corridor.leeway_m", {0.5, LeewayInACorridor}},
    {"explore.speed_m_s", {0.1, SpeedOf(mission_command_t::EXPLORE)}},
};

double Measured(const Story& story, const PlannerConfig& started, const PlannerConfig& told) {
  Workstation w(started);
  w.dut.Reconfigure(told);
  return story.measure(w);
}

TEST(LiveParametersOfThePlanner, EachHasItsStory) {
  ExpectAStoryForEach<PlannerConfig>(kStories);
}

class LiveParameterOfThePlannerTest : public testing::TestWithParam<std::string> {};

TEST_P(LiveParameterOfThePlannerTest, IsObeyedAsIfThePlannerHadBeenStartedWithIt) {
  const Story& story = kStories.at(GetParam());
  ExpectObeyedAtOnce<PlannerConfig>(GetParam(), story.value,
                                    [&](const PlannerConfig& started, const PlannerConfig& given) {
                                      return Measured(story, started, given);
                                    });
}

INSTANTIATE_TEST_SUITE_P(All, LiveParameterOfThePlannerTest, testing::ValuesIn(NamesOf(kStories)),
                         ParameterTestName);

}  // namespace
}  // namespace priamos::planner
