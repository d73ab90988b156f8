#include "world/core/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace priamos::world {
namespace {

constexpr double kGapLimit_m = 10;
/// A touch begins below half a millimetre and ends beyond a centimetre.
constexpr double kContactBegin_m = 0.0005, kContactEnd_m = 0.01;
/// What is lower is rolled over.
constexpr double kFloorClearance_m = 0.02;
constexpr double kSonarHalfBand_m = 0.05;

}  // namespace

Body BodyOf(const RobotModel& model) {
  return {{model.length_m, model.width_m}, kFloorClearance_m, model.height_m};
}

void RobotModel::Describe(Archive& a) {
  a.Number("length_m", length_m, {"m", 0.1, 5, "footprint along x"});
  a.Number("width_m", width_m, {"m", 0.1, 5, "footprint along y"});
  a.Number("height_m", height_m, {"m", 0.1, 5, "top of the robot"});
  a.Section("base", base, "Mecanum wheels");
  a.Section("drive", drive, "drive board: speed control, encoders, dead-line");
  a.Section("motors", motors, "forces of the motors, and their currents");
  a.Section("bumper", bumper, "rubber strip with contact switches");
  a.Section("sonar", sonar, "ring of 24 ultrasonic sensors");
  a.Section("head_motors", head_motors, "motors of KASTOR");
  a.Section("camera", camera, "shutters and readout of the cameras");
}

Simulation::Simulation(const RobotModel& model, const std::vector<Solid>& solids, const Pose2& start,
                       CameraServer& cameras, std::uint64_t seed)
    : body_(BodyOf(model)),
      drive_(model.drive, Rng::Stream(seed, "encoders")),
      base_(model.base, Rng::Stream(seed, "wheels")),
      motor_load_(model.motors, Rng::Stream(seed, "motor load")),
      bumper_(model.bumper, body_.size_m, solids),
      ring_(model.sonar, body_.size_m,
            AcousticScene(solids, model.sonar.height_m, kSonarHalfBand_m, model.sonar.materials),
            Rng::Stream(seed, "sonar")),
      motors_(model.head_motors, Rng::Stream(seed, "head motors")),
      cameras_(cameras),
      clearance_(body_, solids),
      contacts_(kContactBegin_m, kContactEnd_m),
      pose_(start) {
  gap_m_ = clearance_.Gap(pose_, kGapLimit_m);
  if (gap_m_ <= 0) throw std::invalid_argument("the robot starts inside a solid");
  contacts_.Update(gap_m_);
}

Duration Simulation::Advance(Time now) {
  if (!now_) {
    now_ = next_sample_ = next_ping_ = now;
    SampleDevices();
  }
  Duration skipped{0};
  if (now - *now_ > kMaxAdvance + kStep) {
    skipped = (now - *now_ - kMaxAdvance) / kStep * kStep;
    *now_ += skipped;
    next_sample_ += skipped;
    next_ping_ += skipped;
  }
  while (*now_ + kStep <= now) Step();
  return skipped;
}

void Simulation::Step() {
  const Pose2 from = pose_;
  const Time end = *now_ + kStep;
  drive_.Step(end, kStep);
  Move(Seconds(kStep));
  motors_.Step(kStep);
  ExposeUntil(end, from);
  now_ = end;
  // A motion changes the gap by at most its length, so nothing farther needs to be examined.
  gap_m_ = clearance_.Gap(pose_, std::min(kGapLimit_m, gap_m_ + Reach(Seconds(kStep))));
  contacts_.Update(gap_m_);
  Touch();
  SampleDevices();
}

/// The wheels turn as they are driven; where a solid blocks the base it stays before it and they slip.
void Simulation::Move(double dt_s) {
  const Twist2 driven = base_.Step(drive_.speed_rad_s(), dt_s);
  velocity_ = driven;
  const Pose2 wanted = Integrate(pose_, velocity_, dt_s);
  // What is farther away than a step is long cannot block it.
  const double part = gap_m_ > Reach(dt_s) ? 1 : clearance_.FreePart(pose_, wanted);
  if (part < 1) velocity_ = {part * velocity_.vx, part * velocity_.vy, part * velocity_.wz};
  pose_ = part < 1 ? Integrate(pose_, velocity_, dt_s) : wanted;
  const PerWheel rolled = base_.ContactSpeeds(driven), moved = base_.ContactSpeeds(velocity_);
  PerWheel slid;
  for (std::size_t i = 0; i < 4; ++i) slid[i] = rolled[i] - moved[i];
  motor_load_.Step(rolled, slid, dt_s);
}

/// Far from everything no switch is pressed.
void Simulation::Touch() {
  if (gap_m_ < kContactEnd_m) pressed_ |= bumper_.Pressed(pose_);
}

/// Upper bound of the distance that any point of the footprint moves in that time.
double Simulation::Reach(double dt_s) const {
  const double speed_m_s = std::hypot(velocity_.vx, velocity_.vy);
  return (speed_m_s + std::abs(velocity_.wz) * body_.size_m.norm() / 2) * dt_s;
}

/// Shutters open and close between steps, too.
void Simulation::ExposeUntil(Time end, const Pose2& from) {
  for (auto at = cameras_.NextSample(); at && *at <= end; at = cameras_.NextSample()) {
    const double since_s = std::max(0.0, Seconds(*at - *now_));
    cameras_.Sample({Integrate(from, velocity_, since_s), motors_.Truth()});
  }
}

void Simulation::SampleDevices() {
  if (*now_ >= next_sample_) {
    wheels_ = WheelSample{*now_, drive_.Read()};
    touch_ = TouchSample{*now_, motor_load_.Read(), std::exchange(pressed_, std::uint8_t{0})};
    head_ = HeadSample{*now_, motors_.Counters(), motors_.moving()};
    truth_ = CurrentTruth();
    next_sample_ += kSamplePeriod;
  }
  if (*now_ >= next_ping_) {
    ring_.Fire(next_group_, pose_);
    next_ping_ += ring_.GroupPeriod();
    next_group_ = (next_group_ + 1) % ring_.groups();
    if (next_group_ == 0) sonars_ = SonarSample{*now_, ring_.ranges_m()};
  }
}

Truth Simulation::CurrentTruth() const {
  return {*now_, pose_, velocity_, gap_m_, contacts_.min_gap_m(), contacts_.contacts(), motors_.Truth()};
}

}  // namespace priamos::world
