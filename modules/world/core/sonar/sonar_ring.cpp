#include "world/core/sonar/sonar_ring.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {

void SonarConfig::Describe(Archive& a) {
  a.Number("height_m", height_m, {"m", 0.05, 2, "height of the ring above the floor"});
  a.Number("cycle_s", cycle_s, {"s", 0.02, 1, "time for all groups to fire once"});
  a.Integer("groups", groups, {"-", 1, 24, "firing groups, one after the other; a divisor of 24"});
  if (kSonars % groups != 0) a.Refuse("groups", "a divisor of 24");
  a.Number("beam_deg", beam_deg, {"deg", 1, 60, "full beam width, to -6 dB out and back"});
  a.Number("sensitivity_db", sensitivity_db, {"dB", 0, 120, "weakest echo below that of a wall at 1 m"});
  a.Number("absorption_db_m", absorption_db_m, {"dB/m", 0, 10, "absorption by air, one way"});
  a.Number("edge_db", edge_db, {"dB", -100, 0, "echo of a vertical edge against a wall, at 1 m"});
  a.Number("fading_db", fading_db, {"dB", 0, 20, "standard deviation of the level from ping to ping"});
  a.Number("noise_m", noise_m, {"m", 0, 0.1, "standard deviation of a distance"});
  a.Number("noise_per_m", noise_per_m, {"-", 0, 0.1, "growth of the noise with the distance"});
  a.Number("sound_speed_error", sound_speed_error,
           {"-", 0, 0.05, "all distances are off by up to this part (temperature)"});
  a.Number("crosstalk", crosstalk, {"-", 0, 1, "chance per ping to hear another sensor's sound"});
  a.List("materials", materials, "what sound makes of each material; the first stands for those not listed");
}

SonarRing::SonarRing(const SonarConfig& config, const Eigen::Vector2d& footprint_m, AcousticScene scene,
                     Rng rng)
    : config_(config), footprint_m_(footprint_m), scene_(std::move(scene)), rng_(rng) {
  sound_speed_ratio_ = 1 + rng_.Uniform(-config.sound_speed_error, config.sound_speed_error);
  ranges_m_.fill(kNoEcho);
}

void SonarRing::Fire(int group, const Pose2& map_from_base) {
  // Sound that comes back in time has been no farther from its sensor than the range.
  const AcousticScene scene =
      scene_.Around(map_from_base.translation(), kSonarMax_m + footprint_m_.norm() / 2);
  std::vector<std::optional<Echo>> echoes;
  for (int i = group; i < kSonars; i += config_.groups) {
    const double threshold_db = -config_.sensitivity_db + DeafnessDb(i) + rng_.Normal(config_.fading_db);
    echoes.push_back(Ping(scene, config_, map_from_base * BaseFromSonar(i, footprint_m_), threshold_db));
  }
  for (int i = group, k = 0; i < kSonars; i += config_.groups, ++k) {
    std::optional<double> range_m;
    if (echoes[static_cast<std::size_t>(k)]) range_m = echoes[static_cast<std::size_t>(k)]->range_m;
    if (rng_.Chance(config_.crosstalk)) {
      const auto overheard = Overheard(map_from_base * BaseFromSonar(i, footprint_m_), echoes, k);
      if (overheard && (!range_m || *overheard < *range_m)) range_m = overheard;
    }
    const double measured = Measured(range_m);
    if (!Has(i, "stuck")) ranges_m_[static_cast<std::size_t>(i)] = Has(i, "dead") ? kNoEcho : measured;
  }
}

bool SonarRing::Has(int sensor, std::string_view kind) const {
  return std::any_of(faults_.begin(), faults_.end(),
                     [&](const SonarFault& f) { return f.sensor == sensor + 1 && f.kind == kind; });
}

double SonarRing::DeafnessDb(int sensor) const {
  double db = 0;
  for (const SonarFault& fault : faults_)
    if (fault.sensor == sensor + 1 && fault.kind == "deaf") db += fault.deaf_db;
  return db;
}

/// Sound of another sensor of the group that comes in over that sensor's reflector: the path out is that of
/// the other sensor, the path back leads here.
std::optional<double> SonarRing::Overheard(const Pose2& map_from_sonar,
                                           const std::vector<std::optional<Echo>>& echoes, int own) {
  const auto other = static_cast<std::size_t>(rng_.Below(echoes.size()));
  if (other == static_cast<std::size_t>(own) || !echoes[other]) return std::nullopt;
  const double back_m = (echoes[other]->point - map_from_sonar.translation()).norm();
  return (echoes[other]->range_m + back_m) / 2;
}

double SonarRing::Measured(const std::optional<double>& range_m) {
  if (!range_m) return kNoEcho;
  const double noise_m = rng_.Normal(config_.noise_m + config_.noise_per_m * *range_m);
  const double measured = *range_m * sound_speed_ratio_ + noise_m;
  if (measured > kSonarMax_m) return kNoEcho;
  return std::max(std::round(measured / kSonarResolution_m) * kSonarResolution_m, kSonarMin_m);
}

}  // namespace priamos::world
