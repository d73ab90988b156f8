#include "test/bench/rivals/drive.hpp"

#include <cmath>

#include "test/bench/figures.hpp"
#include "test/bench/rivals/case_path.hpp"

namespace priamos::bench {
namespace {

constexpr Duration kTick{10000};  ///< of the world, as its process has it
constexpr int kTicksPerStep = 2;  ///< of a driver
constexpr double kStands_s = 15, kStands_m = 0.05, kStands_rad = 0.1;
constexpr double kMostTimes = 5, kMostMore_s = 10;

/// Notices a base that gets nowhere.
class Standstill {
 public:
  /// Whether it has stood, nearly, since kStands_s.
  bool Add(const Pose2& pose, double now_s) {
    const bool moved = (pose.translation() - anchor_.translation()).norm() > kStands_m ||
                       std::abs(WrapAngle(pose.yaw - anchor_.yaw)) > kStands_rad;
    if (moved || since_s_ < 0) {
      anchor_ = pose;
      since_s_ = now_s;
    }
    return now_s - since_s_ > kStands_s;
  }

 private:
  Pose2 anchor_;
  double since_s_ = -1;
};

/// The world around one drive.
class Stage {
 public:
  Stage(const Case& task, const world::RobotModel& model, std::uint64_t seed)
      : cameras_(model.camera, 0, nobody_draws_, seed),
        world_(model, task.solids, task.order.start, cameras_, seed, task.hazards) {}

  void Advance(Time now, Heard& heard, Drive& drive) {
    world_.Advance(now);
    if (auto wheels = world_.TakeWheels()) heard.wheels = wheels;
    if (auto touch = world_.TakeTouch()) heard.touch = touch;
    if (auto sonars = world_.TakeSonars()) heard.sonars = sonars;
    if (auto truth = world_.TakeTruth()) truth_ = *truth;
    for (const world::TouchEvent& touch : world_.TakeTouchEvents())
      drive.came += touch.kind == world::TouchEvent::Kind::kMovedIn;
    drive.contacts = truth_.contacts;
    drive.min_gap_m = truth_.min_gap_m;
  }
  void Command(Time now, const world::PerWheel& speeds) { world_.CommandWheels(now, 1, speeds); }
  const Pose2& pose() const { return truth_.map_from_base; }

 private:
  world::InlineRenderExecutor nobody_draws_{[](const world::RenderJob&) { return GreyImage{1, 1, {0}}; }};
  world::CameraServer cameras_;
  world::Simulation world_;
  world::Truth truth_{};
};

}  // namespace

Drive DriveCase(const Case& task, const world::RobotModel& model, Driver& driver, std::uint64_t seed,
                const Witness& witness) {
  Stage stage(task, model, seed);
  Standstill standstill;
  Drive drive;
  Heard heard;
  const Time begin = FromUtime(1'000'000'000);
  const double most_s = kMostTimes * task.length_m / kPathSpeed_m_s + kMostMore_s;
  int steps = 0;
  for (int tick = 0; tick * Seconds(kTick) < most_s; ++tick) {
    const Time now = begin + tick * kTick;
    stage.Advance(now, heard, drive);
    if (tick % kTicksPerStep != 0) continue;
    const double from_s = CpuSeconds();
    const auto speeds = driver.Step(heard, now);
    drive.step_s += CpuSeconds() - from_s;
    ++steps;
    if (speeds) stage.Command(now, *speeds);
    if (witness) witness(heard, stage.pose());
    heard = {};
    drive.seconds = Seconds(now - begin);
    drive.arrived = (stage.pose().translation() - task.goal().translation()).norm() < kThere_m;
    if (drive.arrived || standstill.Add(stage.pose(), drive.seconds)) break;
  }
  drive.step_s /= std::max(1, steps);
  return drive;
}

}  // namespace priamos::bench
