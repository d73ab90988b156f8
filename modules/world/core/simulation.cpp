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
/// A base that comes nearer than this does so by itself.
constexpr double kComes_m_s = 0.01;

PerWheelPoints WheelsOf(const MecanumConfig& base) {
  const double x = base.half_wheelbase_m, y = base.half_track_m;
  return {Eigen::Vector2d{x, y}, {x, -y}, {-x, y}, {-x, -y}};
}

std::vector<std::string> NamesOf(const std::vector<Solid>& solids) {
  std::vector<std::string> names;
  names.reserve(solids.size());
  for (const Solid& solid : solids) names.push_back(solid.name);
  return names;
}

bool Moves(const Movers& movers, std::size_t solid) {
  const auto& moved = movers.moved();
  return std::any_of(moved.begin(), moved.end(), [&](const MovedSolid& m) { return m.solid == solid; });
}

/// Point of the footprint that is nearest to the middle of an outline, base frame.
Eigen::Vector2d NearestPoint(const Body& body, const Pose2& pose, const Rectangle& outline) {
  const Eigen::Vector2d half = body.size_m / 2;
  return (pose.Inverse() * outline.map_from_centre.translation()).cwiseMax(-half).cwiseMin(half);
}

/// Whether the base, driven so, comes nearer to its neighbour.
bool Comes(const std::optional<Clearance::Neighbour>& neighbour, const Pose2& pose, const Body& body,
           const Twist2& driven) {
  if (!neighbour) return false;
  const Eigen::Vector2d point = NearestPoint(body, pose, neighbour->outline);
  const Eigen::Vector2d towards = pose.Inverse() * neighbour->outline.map_from_centre.translation() - point;
  const Eigen::Vector2d velocity(driven.vx - driven.wz * point.y(), driven.vy + driven.wz * point.x());
  return towards.norm() > 1e-6 && velocity.dot(towards.normalized()) > kComes_m_s;
}

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
                       CameraServer& cameras, std::uint64_t seed, const Hazards& hazards)
    : body_(BodyOf(model)),
      wheels_in_base_(WheelsOf(model.base)),
      names_(NamesOf(solids)),
      holes_(hazards.holes),
      faults_(hazards.faults),
      drive_(model.drive, Rng::Stream(seed, "encoders")),
      base_(model.base, Rng::Stream(seed, "wheels")),
      motor_load_(model.motors, Rng::Stream(seed, "motor load")),
      bumper_(model.bumper, body_.size_m, solids),
      ring_(model.sonar, body_.size_m,
            AcousticScene(solids, model.sonar.height_m, kSonarHalfBand_m, model.sonar.materials),
            Rng::Stream(seed, "sonar")),
      motors_(model.head_motors, Rng::Stream(seed, "head motors")),
      cameras_(cameras),
      movers_(hazards.people, hazards.leaves, solids, seed),
      mast_(hazards.mast),
      clearance_(body_, solids, [this](std::size_t solid) { return !Moves(movers_, solid); }),
      moving_clearance_(body_, solids, [this](std::size_t solid) { return Moves(movers_, solid); }),
      contacts_(kContactBegin_m, kContactEnd_m),
      moving_contacts_(kContactBegin_m, kContactEnd_m),
      pose_(start) {
  gap_m_ = clearance_.Gap(pose_, kGapLimit_m);
  moving_gap_m_ = moving_clearance_.Gap(pose_, kGapLimit_m);
  min_gap_m_ = std::min(gap_m_, moving_gap_m_);
  if (min_gap_m_ <= 0) throw std::invalid_argument("the robot starts inside a solid");
  contacts_.Update(gap_m_);
  moving_contacts_.Update(moving_gap_m_);
  Fall();
  if (falls_ > 0) throw std::invalid_argument("the robot starts over a hole");
}

Duration Simulation::Advance(Time now) {
  if (!now_) {
    now_ = started_ = next_sample_ = next_ping_ = now;
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
  mast_.Step(velocity_, Seconds(kStep));
  motors_.Step(kStep);
  ExposeUntil(end, from);
  now_ = end;
  BreakDevices();
  MoveOthers(Seconds(kStep));
  UpdateGaps(Reach(Seconds(kStep)));
  Touch();
  Fall();
  SampleDevices();
}

/// A motion changes the gap by at most its length, so nothing farther needs to be examined.
void Simulation::UpdateGaps(double reach_m) {
  gap_m_ = clearance_.Gap(pose_, std::min(kGapLimit_m, gap_m_ + reach_m));
  min_gap_m_ = std::min(min_gap_m_, gap_m_);
  const int before = contacts_.contacts();
  contacts_.Update(gap_m_);
  if (contacts_.contacts() > before) NoteTouch(clearance_, true);
  if (movers_.empty()) return;
  moving_gap_m_ = moving_clearance_.Gap(pose_, kGapLimit_m);
  const bool came = Comes(moving_clearance_.Nearest(pose_), pose_, body_, driven_);
  // A person who comes near a base that stands or leaves is not the base's doing.
  if (came) min_gap_m_ = std::min(min_gap_m_, moving_gap_m_);
  const int moving_before = moving_contacts_.contacts();
  moving_contacts_.Update(moving_gap_m_);
  if (moving_contacts_.contacts() == moving_before) return;
  driven_into_movers_ += came;
  NoteTouch(moving_clearance_, came);
}

void Simulation::NoteTouch(const Clearance& clearance, bool driven) {
  const auto nearest = clearance.Nearest(pose_);
  if (!nearest) return;
  const auto kind = driven ? TouchEvent::Kind::kDriven : TouchEvent::Kind::kMovedIn;
  touch_events_.push_back(
      {*now_, kind, names_[nearest->solid], NearestPoint(body_, pose_, nearest->outline)});
}

/// A wheel over a hole drops: the base lies on its belly and does not move any more.
void Simulation::Fall() {
  if (falls_ > 0 || holes_.empty()) return;
  for (const Eigen::Vector2d& wheel : wheels_in_base_) {
    const HolePlan* hole = HoleAt(holes_, pose_ * wheel);
    if (!hole) continue;
    falls_ = 1;
    if (now_) touch_events_.push_back({*now_, TouchEvent::Kind::kFell, hole->name, wheel});
    return;
  }
}

/// People walk and leaves swing; whoever hears, feels or is touched learns of it.
void Simulation::MoveOthers(double dt_s) {
  if (movers_.empty()) return;
  movers_.Step(SinceStart(), dt_s, Footprint());
  for (const MovedSolid& moved : movers_.moved()) {
    moving_clearance_.Move(moved);
    bumper_.Move(moved);
  }
}

void Simulation::BreakDevices() {
  const auto due = [this](const auto& fault) { return fault.at_s <= SinceStart(); };
  for (const SonarFault& fault : faults_.sonars)
    if (due(fault)) ring_.Break(fault);
  for (const MotorFault& fault : faults_.motors) {
    if (!due(fault)) continue;
    motor_load_.Release(fault.index());
    fault.kind == "stalled" ? drive_.Stall(fault.index()) : base_.Loosen(fault.index());
  }
  std::erase_if(faults_.sonars, due);
  std::erase_if(faults_.motors, due);
}

/// The wheels turn as they are driven; where a solid blocks the base it stays before it and they slip.
void Simulation::Move(double dt_s) {
  const Twist2 driven = base_.Step(drive_.speed_rad_s(), dt_s);
  velocity_ = driven_ = driven;
  if (falls_ > 0) {  // the wheels turn in the air
    velocity_ = {};
    motor_load_.Step(PerWheel{}, PerWheel{}, dt_s);
    return;
  }
  const Pose2 wanted = Integrate(pose_, velocity_, dt_s);
  // What is farther away than a step is long cannot block it.
  double part = gap_m_ > Reach(dt_s) ? 1 : clearance_.FreePart(pose_, wanted);
  if (!movers_.empty() && moving_gap_m_ <= Reach(dt_s))
    part = std::min(part, moving_clearance_.FreePart(pose_, wanted));
  if (part < 1) velocity_ = {part * velocity_.vx, part * velocity_.vy, part * velocity_.wz};
  pose_ = part < 1 ? Integrate(pose_, velocity_, dt_s) : wanted;
  const PerWheel rolled = base_.ContactSpeeds(driven), moved = base_.ContactSpeeds(velocity_);
  PerWheel slid;
  for (std::size_t i = 0; i < 4; ++i) slid[i] = rolled[i] - moved[i];
  motor_load_.Step(rolled, slid, dt_s);
}

/// Far from everything no switch is pressed.
void Simulation::Touch() {
  if (std::min(gap_m_, moving_gap_m_) < kContactEnd_m) pressed_ |= bumper_.Pressed(pose_);
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
    HeadAxes axes = motors_.Truth();
    axes.lean = mast_.lean();
    cameras_.Sample({Integrate(from, velocity_, since_s), axes, movers_.moved()});
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
    for (const MovedSolid& moved : movers_.moved()) ring_.Move(moved);
    ring_.Fire(next_group_, pose_);
    next_ping_ += ring_.GroupPeriod();
    next_group_ = (next_group_ + 1) % ring_.groups();
    if (next_group_ == 0) sonars_ = SonarSample{*now_, ring_.ranges_m()};
  }
}

Truth Simulation::CurrentTruth() const {
  const int contacts = contacts_.contacts() + driven_into_movers_ + falls_;
  return {*now_,      pose_,    velocity_,      movers_.empty() ? gap_m_ : std::min(gap_m_, moving_gap_m_),
          min_gap_m_, contacts, motors_.Truth()};
}

}  // namespace priamos::world
