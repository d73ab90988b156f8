#include "robot/core/sonar/mover_watch.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr std::size_t kLeastEchoes = 5;
/// A base that turns faster sweeps its beams over things that stand.
constexpr double kTurning_rad_s = 0.15;
/// Of a velocity that no echo confirms so much is left after a cycle.
constexpr double kForgets = 0.8;
constexpr double kSlant = 2;    ///< how far a face changes its distance along an axis, per distance across
constexpr double kKnown = 2.5;  ///< the residual may be so much larger
constexpr double kStands_m_s = 0.1, kStoodWithin_m = 0.2;
constexpr double kWalks = 0.7;    ///< of the way that the slowest mover goes shows that it goes
constexpr double kApart_m = 0.1;  ///< of the places that are kept free

}  // namespace

void MoverConfig::Describe(Archive& a) {
  a.Number("ahead_deg", ahead_deg,
           {"deg", 5, 180, "of who comes by a sensor farther off the heading nothing is kept free"});
  a.Number("window_s", window_s, {"s", 0.3, 3, "echoes of so long tell whether something comes"});
  a.Number("least_m_s", least_m_s, {"m/s", 0.1, 2, "what comes more slowly counts as standing"});
  a.Number("residual_m", residual_m, {"m", 0.02, 1, "error of the line through the echoes, at most"});
  a.Number("gate_m", gate_m, {"m", 0.05, 1, "the next echo lies so near to where it is expected"});
  a.Number("lost_s", lost_s, {"s", 0.2, 30, "without an echo a mover is forgotten after this"});
  a.Number("standing_s", standing_s, {"s", 1, 600, "having stood for so long it is an ordinary thing"});
  a.Number("walks_s", walks_s,
           {"s", 0.2, 600, "who has not gone on for so long since it was found was none"});
  a.Number("horizon_s", horizon_s, {"s", 0, 5, "what it walks over in this time is kept free"});
  a.Number("body_m", body_m, {"m", 0, 1, "feet and shoulders reach so far beyond the echo"});
}

MoverWatch::MoverWatch(const MoverConfig& config, const Footprint& footprint)
    : config_(config), footprint_(footprint) {}

void MoverWatch::Add(const SonarCycle& cycle, const Pose2& odom_from_base) {
  const double dt_s = last_ ? std::max(Seconds(cycle.time - *last_), 1e-3) : 0.1;
  const bool turns =
      last_pose_ && std::abs(WrapAngle(odom_from_base.yaw - last_pose_->yaw)) > kTurning_rad_s * dt_s;
  last_pose_ = odom_from_base;
  last_ = cycle.time;
  std::vector<Eigen::Vector2d> echoes;
  std::vector<Coming> coming;
  for (std::size_t i = 0; i < heard_.size(); ++i) {
    const Pose2 base_from_sonar = BaseFromSonar(static_cast<int>(i), footprint_.Size());
    const Pose2 odom_from_sonar = odom_from_base * base_from_sonar;
    if (turns) heard_[i].clear();
    if (!Keep(heard_[i], cycle.time, odom_from_sonar, cycle.range_m[i])) continue;
    echoes.push_back(odom_from_sonar * Eigen::Vector2d(cycle.range_m[i], 0));
    auto one = ComingIn(heard_[i], odom_from_sonar);
    if (!one) continue;
    one->beside = std::abs(base_from_sonar.yaw) > Radians(config_.ahead_deg);
    coming.push_back(*one);
  }
  Follow(echoes, cycle.time);
  for (const Coming& one : coming) Found(one, cycle.time);
}

/// Adds an echo to those of the last half second; false when it is none.
bool MoverWatch::Keep(std::deque<Sample>& samples, Time now, const Pose2& odom_from_sonar,
                      double range_m) const {
  constexpr double kJitter_s = 0.05;
  while (!samples.empty() && Seconds(now - samples.front().time) > config_.window_s + kJitter_s)
    samples.pop_front();
  if (!IsEcho(range_m)) return false;
  samples.push_back({now, odom_from_sonar.translation(), range_m});
  return true;
}

/// What comes along the axis of a sensor. Of who is known to walk the swing of the legs is no doubt.
std::optional<MoverWatch::Coming> MoverWatch::ComingIn(const std::deque<Sample>& samples,
                                                       const Pose2& odom_from_sonar) const {
  const Eigen::Vector2d axis = odom_from_sonar.rotation().col(0);
  const Eigen::Vector2d at = odom_from_sonar.translation() + samples.back().range_m * axis;
  const bool known = IsOfMover(at);
  const auto speed = ClosingSpeed(samples, axis, config_.residual_m * (known ? kKnown : 1));
  // A beam that is carried across a slanted face that stands hears it come.
  const Eigen::Vector2d driven = samples.back().sonar - samples.front().sonar;
  const double across_m = std::abs(axis.x() * driven.y() - axis.y() * driven.x());
  const double across_m_s = across_m / config_.window_s;
  if (!known && speed && *speed < config_.least_m_s + kSlant * across_m_s) return std::nullopt;
  return speed ? std::optional(Coming{at, -*speed * axis}) : std::nullopt;
}

/// Speed along the axis towards the sensor by least squares; nullopt where the echoes lie on no line, or one
/// that does not come.
std::optional<double> MoverWatch::ClosingSpeed(const std::deque<Sample>& samples, const Eigen::Vector2d& axis,
                                               double residual_m) const {
  if (samples.size() < kLeastEchoes ||
      Seconds(samples.back().time - samples.front().time) < 0.75 * config_.window_s)
    return std::nullopt;
  const auto n = static_cast<double>(samples.size());
  const Time now = samples.back().time;
  const auto place = [&axis](const Sample& s) { return s.sonar.dot(axis) + s.range_m; };
  double t_mean = 0, p_mean = 0;
  for (const Sample& s : samples) {
    t_mean += Seconds(s.time - now) / n;
    p_mean += place(s) / n;
  }
  double tt = 0, tp = 0;
  for (const Sample& s : samples) {
    const double t = Seconds(s.time - now) - t_mean;
    tt += t * t;
    tp += t * (place(s) - p_mean);
  }
  const double slope = tp / tt;
  if (slope > -config_.least_m_s) return std::nullopt;
  const bool on_line = std::all_of(samples.begin(), samples.end(), [&](const Sample& s) {
    return std::abs(place(s) - p_mean - slope * (Seconds(s.time - now) - t_mean)) < residual_m;
  });
  return on_line ? std::optional(-slope) : std::nullopt;
}

/// Each mover goes on with the echo nearest to where it is expected.
void MoverWatch::Follow(const std::vector<Eigen::Vector2d>& echoes, Time now) {
  for (Mover& mover : movers_) {
    const double since_s = Seconds(now - mover.seen);
    const Eigen::Vector2d expected = mover.at + since_s * mover.velocity;
    const auto distance = [&](const Eigen::Vector2d& echo) { return (echo - expected).norm(); };
    const auto nearest = std::min_element(echoes.begin(), echoes.end(), [&](const auto& a, const auto& b) {
      return distance(a) < distance(b);
    });
    mover.velocity *= kForgets;
    if (nearest == echoes.end() || distance(*nearest) > config_.gate_m) continue;
    mover.at = *nearest;
    mover.seen = now;
    NoteWalk(mover, now);
    if ((mover.at - mover.stood_at).norm() < kStoodWithin_m) continue;
    mover.stood_at = mover.at;
    mover.stood = now;
  }
  std::erase_if(movers_, [&](const Mover& mover) { return IsNone(mover, now); });
}

/// A beam that the base carries from what is behind a thing to its edge, or back and forth between the two,
/// hears something come as well, but that gets nowhere.
void MoverWatch::NoteWalk(Mover& mover, Time now) const {
  const double went_m = (mover.at - mover.found_at).dot(mover.heading);
  if (Seconds(now - mover.found) <= config_.walks_s && went_m > kWalks * config_.least_m_s * config_.walks_s)
    mover.walks = true;
}

/// Whether it is a mover no more, or never was.
bool MoverWatch::IsNone(const Mover& mover, Time now) const {
  if (!mover.walks && Seconds(now - mover.found) > config_.walks_s) return true;
  return Seconds(now - mover.seen) > config_.lost_s || Seconds(now - mover.stood) > config_.standing_s;
}

void MoverWatch::Found(const Coming& coming, Time now) {
  const auto& [at, velocity, beside] = coming;
  const auto known = std::find_if(movers_.begin(), movers_.end(), [&](const Mover& mover) {
    return (mover.at - coming.at).norm() < 2 * config_.gate_m;
  });
  if (known == movers_.end()) {
    movers_.push_back({at, velocity, now, at, now, beside, at, velocity.normalized(), now});
    return;
  }
  // Of two sensors that hear it the nearer place counts, and the faster motion.
  known->seen = now;
  known->beside = known->beside && beside;
  if (velocity.norm() > known->velocity.norm()) known->velocity = velocity;
}

bool MoverWatch::IsAboutToMeet(const Pose2& odom_from_base, const Eigen::Vector2d& velocity,
                               double within_s) const {
  constexpr int kLooked = 15;
  const Pose2 base_from_odom = odom_from_base.Inverse();
  return std::any_of(movers_.begin(), movers_.end(), [&](const Mover& mover) {
    if (mover.velocity.norm() < config_.least_m_s) return false;
    const Eigen::Vector2d at = base_from_odom * mover.at,
                          relative = base_from_odom.rotation() * mover.velocity - velocity;
    for (int i = 0; i <= kLooked; ++i)
      if (footprint_.Distance(at + within_s * i / kLooked * relative) < config_.body_m) return true;
    return false;
  });
}

const Mover* MoverWatch::NearestAhead(const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  const Mover* nearest = nullptr;
  double least_m = 0;
  for (const Mover& mover : movers_) {
    const Eigen::Vector2d at = base_from_odom * mover.at;
    const double distance_m = footprint_.Distance(at);
    if (mover.beside || at.x() < 0 || (nearest && distance_m >= least_m)) continue;
    nearest = &mover;
    least_m = distance_m;
  }
  return nearest;
}

bool MoverWatch::IsOfMover(const Eigen::Vector2d& odom) const {
  return std::any_of(movers_.begin(), movers_.end(), [&](const Mover& mover) {
    return !mover.beside && (mover.at - odom).norm() < config_.gate_m + config_.body_m / 2;
  });
}

std::vector<Eigen::Vector2d> MoverWatch::Points(const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<Eigen::Vector2d> points;
  for (const Mover& mover : movers_) {
    if (mover.beside) continue;
    const Eigen::Vector2d at = base_from_odom * mover.at;
    Eigen::Vector2d along = base_from_odom.rotation() * mover.velocity;
    const double speed = along.norm();
    // Whoever stands may set off towards the base.
    along = speed > kStands_m_s ? along / speed : Eigen::Vector2d(-at.normalized());
    const Eigen::Vector2d left(-along.y(), along.x());
    const double reach_m = config_.body_m + (speed > kStands_m_s ? speed * config_.horizon_s : 0);
    const int n = 1 + static_cast<int>(reach_m / kApart_m);
    for (int i = 0; i <= n; ++i)
      for (const double side : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const Eigen::Vector2d point = at + reach_m * i / n * along + side * config_.body_m * left;
        if (footprint_.Distance(point) > 0) points.push_back(point);
      }
  }
  return points;
}

}  // namespace priamos::robot
