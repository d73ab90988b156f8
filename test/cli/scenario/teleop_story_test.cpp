#include "cli/scenario/teleop_story.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "stage.hpp"

namespace priamos::cli {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// The computer's end of the mouse's cable.
class MouseEnd : public ByteStream {
 public:
  std::size_t Read(std::span<std::byte> into) override {
    const std::size_t n = std::min(into.size(), to_mouse.size());
    for (std::size_t i = 0; i < n; ++i) into[i] = static_cast<std::byte>(to_mouse[i]);
    to_mouse.erase(0, n);
    return n;
  }
  std::size_t Write(std::span<const std::byte> bytes) override {
    from_mouse.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return bytes.size();
  }
  std::string to_mouse = "m3\r", from_mouse;
};

/// The cable that a story holds and a test looks at.
class Shared : public ByteStream {
 public:
  explicit Shared(MouseEnd& end) : end_(end) {}
  std::size_t Read(std::span<std::byte> into) override { return end_.Read(into); }
  std::size_t Write(std::span<const std::byte> bytes) override { return end_.Write(bytes); }

 private:
  MouseEnd& end_;
};

Scenario Drive() {
  Scenario scenario;
  scenario.story = "teleop";
  scenario.time_limit_s = 60;
  scenario.processes.resize(1);
  scenario.processes[0].module = "robot";
  scenario.processes[0].bus = "onboard";
  scenario.waypoints = {{1.0, 0, 0}, {2.0, 0, 0}};
  return scenario;
}

/// A robot that goes where the test puts it, and an operator at the mouse.
class TeleopStoryTest : public testing::Test {
 protected:
  explicit TeleopStoryTest(const Scenario& scenario = Drive()) : stage_(scenario) {
    story_ = std::make_unique<TeleopStory>(
        StoryStage{stage_.scenario, 1, stage_.onboard_node, stage_.offboard_node,
                   [this] { return std::make_unique<Shared>(mouse_); },
                   [this](Time, const std::string& text) { told_.push_back(text); }});
  }
  void Tick(double seconds = 0.1) {
    for (int i = 0; i < std::lround(seconds / 0.1); ++i) {
      stage_.clock.Set(stage_.clock.Now() + FromSeconds(0.1));
      stage_.Live();
      truth_.Publish(where_);
      drive_.Publish(status_);
      stage_.onboard.Drain();
      stage_.offboard.Drain();
      story_->Tick(stage_.clock.Now());
    }
  }
  void GrantLease() { status_.driver = lease_request_t::TELEOP; }
  bool Done() const { return story_->Done(stage_.clock.Now()); }

  Stage stage_;
  MouseEnd mouse_;
  std::vector<std::string> told_;
  std::unique_ptr<TeleopStory> story_;
  world_truth_t where_{};
  drive_status_t status_{};
  bus::Publisher<world_truth_t> truth_ = stage_.onboard_other.Advertise(channels::kWorldTruth);
  bus::Publisher<drive_status_t> drive_ = stage_.offboard_other.Advertise(channels::kDriveStatus);
};

TEST_F(TeleopStoryTest, BeginsWhenEverythingIsAliveAndTheMouseIsAwake) {
  mouse_.to_mouse.clear();
  Tick(1);
  EXPECT_FALSE(story_->Started()) << "nobody has switched the mouse on";
  EXPECT_EQ(story_->Reason(), "not all processes came to life");
  mouse_.to_mouse = "m3\r";
  Tick(0.2);
  EXPECT_TRUE(story_->Started());
  EXPECT_THAT(told_, Contains("all processes are alive; the operator takes the space-mouse"));
}

TEST_F(TeleopStoryTest, PressesTheDeadManFirstAndPushesOnlyWithTheLease) {
  Tick(1);
  EXPECT_THAT(mouse_.from_mouse, HasSubstr("k")) << "keys";
  EXPECT_EQ(mouse_.from_mouse.find('d'), std::string::npos) << "no motion: " << mouse_.from_mouse;
  GrantLease();
  Tick(0.5);
  EXPECT_NE(mouse_.from_mouse.find('d'), std::string::npos) << "motion";
}

TEST_F(TeleopStoryTest, WithoutAnAnswerTheGripIsRepeated) {
  Tick(1);
  const std::size_t before = mouse_.from_mouse.size();
  Tick(1);
  EXPECT_EQ(mouse_.from_mouse.size(), before) << "he holds it";
  Tick(3);
  EXPECT_GT(mouse_.from_mouse.size(), before) << "let go and pressed again";
}

TEST_F(TeleopStoryTest, DrivesFromWaypointToWaypointAndIsDoneAWhileLater) {
  GrantLease();
  Tick(1);
  where_.x_m = 0.95;
  Tick();
  EXPECT_THAT(told_, Contains("at waypoint 1 of 2: (0.95, 0.00) m"));
  EXPECT_FALSE(story_->Succeeded());
  where_.x_m = 2.05;
  Tick();
  EXPECT_TRUE(story_->Succeeded());
  EXPECT_EQ(story_->Reason(), "the operator is where he wanted to be");
  EXPECT_FALSE(Done()) << "what happens right afterwards belongs to the run";
  Tick(1.5);
  EXPECT_TRUE(Done());
}

TEST_F(TeleopStoryTest, AWaypointIsNotReachedFromFarther) {
  GrantLease();
  Tick(1);
  where_.x_m = 1.0 - 0.13;
  Tick(0.5);
  EXPECT_THAT(told_, testing::Not(Contains(HasSubstr("at waypoint"))));
}

TEST_F(TeleopStoryTest, ATouchEndsItAtOnce) {
  GrantLease();
  Tick(1);
  where_.contacts = 1;
  Tick();
  EXPECT_FALSE(story_->Succeeded());
  EXPECT_EQ(story_->Reason(), "the base touched something");
  EXPECT_TRUE(story_->DecidesTheRun());
}

TEST_F(TeleopStoryTest, TheTimeLimitNamesTheWaypointThatWasNotReached) {
  GrantLease();
  Tick(1);
  where_.x_m = 1;
  Tick(60);
  EXPECT_TRUE(Done());
  EXPECT_FALSE(story_->Succeeded());
  EXPECT_EQ(story_->Reason(), "time limit of 60 s reached on the way to waypoint 2");
}

Scenario Shaking() {
  Scenario scenario = Drive();
  scenario.waypoints.clear();
  scenario.shake_s = 5;
  return scenario;
}

class ShakingTest : public TeleopStoryTest {
 protected:
  ShakingTest() : TeleopStoryTest(Shaking()) {}
};

TEST_F(ShakingTest, WithoutWaypointsHeShakesForAsLongAsTheScenarioSays) {
  GrantLease();
  Tick(4.5);
  EXPECT_FALSE(story_->Succeeded());
  EXPECT_NE(mouse_.from_mouse.find('d'), std::string::npos);
  Tick(1);
  EXPECT_TRUE(story_->Succeeded());
  EXPECT_EQ(story_->Reason(), "the operator has shaken enough");
}

}  // namespace
}  // namespace priamos::cli
