#include <algorithm>
#include <cmath>

#include "world/core/sonar/sonar_ring.hpp"

namespace priamos::world {
namespace {

constexpr int kMirrors = 2;
constexpr double kRayStep_deg = 1.5;
constexpr double kMembrane_m = 0.02;  ///< radius of the sensor's membrane

/// Level of the beam, out and back together, `off_axis_deg` beside its axis [dB]: -6 dB at its edge.
double BeamDb(const SonarConfig& config, double off_axis_deg) {
  const double part = off_axis_deg / (config.beam_deg / 2);
  return -6 * part * part;
}

/// Spreading (`decades` dB per factor 10 of distance) and absorption, against 1 m.
double PathDb(const SonarConfig& config, double range_m, double decades) {
  const double r = std::max(range_m, kSonarMin_m);
  return -decades * std::log10(r) - 2 * config.absorption_db_m * (r - 1);
}

/// Level that a surface sends straight back at `incidence_deg` [dB].
double BackscatterDb(const EchoMaterial& material, double incidence_deg) {
  double db = material.diffuse_db;
  if (incidence_deg <= material.specular_limit_deg) {
    const double part = incidence_deg / material.specular_limit_deg;
    db = std::max(db, -6 * part * part);
  }
  return db;
}

double AngleDeg(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return Degrees(std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
}

/// One ping under way: the nearest echo that was loud enough so far.
class Listener {
 public:
  Listener(const AcousticScene& scene, const SonarConfig& config, const Pose2& map_from_sonar,
           double threshold_db)
      : scene_(scene),
        config_(config),
        at_(map_from_sonar.translation()),
        axis_(map_from_sonar.rotation().col(0)),
        threshold_db_(threshold_db) {}

  void HearRay(double off_axis_deg);
  void HearEdges();
  const std::optional<Echo>& nearest() const { return nearest_; }

 private:
  void Hear(double range_m, double level_db, const Eigen::Vector2d& point) {
    if (level_db >= threshold_db_ && range_m <= Limit()) nearest_ = Echo{range_m, point};
  }
  /// Farther echoes cannot become the first one.
  double Limit() const { return nearest_ ? nearest_->range_m : kSonarMax_m; }
  void HearReturn(const AcousticScene::Hit& mirror, const Eigen::Vector2d& direction, double path_m,
                  double level_db, double free_m);

  const AcousticScene& scene_;
  const SonarConfig& config_;
  Eigen::Vector2d at_, axis_;
  double threshold_db_;
  std::optional<Echo> nearest_;
};

void Listener::HearRay(double off_axis_deg) {
  Eigen::Vector2d origin = at_;
  Eigen::Vector2d direction = Pose2{0, 0, Radians(off_axis_deg)}.rotation() * axis_;
  const double beam_db = BeamDb(config_, off_axis_deg);
  std::optional<AcousticScene::Hit> mirror;
  double path_m = 0, mirror_db = 0;
  for (int bounce = 0; bounce <= kMirrors; ++bounce) {
    // A ray that comes back needs at most the distance out again; a ray in the open is no longer of interest.
    const auto hit = scene_.Nearest(origin, direction, 2 * Limit() - path_m);
    const double free_m = hit ? hit->distance_m : 2 * kSonarMax_m;
    if (bounce == kMirrors) HearReturn(*mirror, direction, path_m, beam_db / 2 + mirror_db, free_m);
    if (!hit) return;
    path_m += hit->distance_m;
    // Straight back along the same path, over the mirrors passed so far.
    const double surface_db = BackscatterDb(*hit->material, AngleDeg(-direction, hit->normal));
    Hear(path_m, beam_db + 2 * mirror_db + surface_db + PathDb(config_, path_m, 20), hit->point);
    mirror_db -= hit->material->reflection_loss_db;
    mirror = hit;
    direction -= 2 * direction.dot(hit->normal) * hit->normal;
    origin = hit->point + 1e-6 * hit->normal;
  }
}

/// Two mirrors at a right angle send sound back where it came from: inner corners are loud. `free_m` is how
/// far the ray runs after its last mirror, `level_db` holds its losses up to there.
void Listener::HearReturn(const AcousticScene::Hit& mirror, const Eigen::Vector2d& direction, double path_m,
                          double level_db, double free_m) {
  const Eigen::Vector2d to_sensor = at_ - mirror.point;
  const double back_m = to_sensor.dot(direction);
  if (back_m <= 0 || back_m > free_m) return;
  const double range_m = (path_m + back_m) / 2;
  // Neighbouring rays are this far apart at their end; between them they cover the membrane.
  const double reach_m = kMembrane_m + range_m * Radians(kRayStep_deg);
  if ((to_sensor - direction * back_m).norm() > reach_m) return;
  const double arrival_db = BeamDb(config_, AngleDeg(-direction, axis_)) / 2;
  Hear(range_m, level_db + arrival_db + PathDb(config_, range_m, 20), mirror.point);
}

void Listener::HearEdges() {
  for (const auto& edge : scene_.edges()) {
    const Eigen::Vector2d delta = edge.point - at_;
    const double range_m = delta.norm();
    if (range_m > Limit() || range_m < 1e-3) continue;
    const double off_axis_deg = AngleDeg(delta / range_m, axis_);
    if (off_axis_deg > config_.beam_deg) continue;
    const double level_db = config_.edge_db + BeamDb(config_, off_axis_deg) + PathDb(config_, range_m, 30);
    if (level_db >= threshold_db_ && scene_.Visible(at_, edge.point)) Hear(range_m, level_db, edge.point);
  }
}

}  // namespace

std::optional<Echo> Ping(const AcousticScene& scene, const SonarConfig& config, const Pose2& map_from_sonar,
                         double threshold_db) {
  Listener listener(scene, config, map_from_sonar, threshold_db);
  listener.HearRay(0);
  // Twice the half width: out to -24 dB.
  const int rays_beside = static_cast<int>(config.beam_deg / kRayStep_deg);
  for (int i = 1; i <= rays_beside; ++i) {
    listener.HearRay(i * kRayStep_deg);
    listener.HearRay(-i * kRayStep_deg);
  }
  listener.HearEdges();
  return listener.nearest();
}

}  // namespace priamos::world
