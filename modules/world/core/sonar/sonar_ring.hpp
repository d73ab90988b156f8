#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/sonar_ring.hpp"
#include "common/time.hpp"
#include "world/core/scene/device_faults.hpp"
#include "world/core/sonar/acoustic_scene.hpp"

namespace priamos::world {

/// The ring of 24 ultrasonic sensors. Levels are in dB against a smooth wall 1 m before the sensor.
struct SonarConfig {
  double height_m = 0.4;
  double cycle_s = 0.1;
  int groups = 3;
  double beam_deg = 15;
  double sensitivity_db = 45;
  double absorption_db_m = 1.3;
  double edge_db = -30;
  double fading_db = 2;
  double noise_m = 0.003;
  double noise_per_m = 0.002;
  double sound_speed_error = 0.004;
  double crosstalk = 0.004;
  std::vector<EchoMaterial> materials = EchoMaterial::Defaults();

  void Describe(Archive& a);
};

inline constexpr double kSonarResolution_m = 0.01, kNoEcho = -1;

/// The first echo of one ping.
struct Echo {
  double range_m;         ///< half the distance that the sound travels, before noise
  Eigen::Vector2d point;  ///< last reflector, map
};

/// What one sensor hears, without noise: rays over the beam, mirrored at up to two surfaces, plus edges that
/// diffract. An echo counts when its level exceeds `threshold_db`; the nearest that counts is the first.
std::optional<Echo> Ping(const AcousticScene& scene, const SonarConfig& config, const Pose2& map_from_sonar,
                         double threshold_db);

/// The ring and its sequencer: sensors i, i + groups, ... fire together, one group after the other through
/// the cycle, so that sound of one group dies out before the next fires, but within a group a sensor may
/// hear its neighbour's sound (cross-talk).
class SonarRing {
 public:
  SonarRing(const SonarConfig& config, const Eigen::Vector2d& footprint_m, AcousticScene scene, Rng rng);

  int groups() const { return config_.groups; }
  Duration GroupPeriod() const { return FromSeconds(config_.cycle_s) / config_.groups; }
  /// From now on a sensor is broken.
  void Break(const SonarFault& fault) { faults_.push_back(fault); }
  /// Fires one group with the base at `map_from_base`.
  void Fire(int group, const Pose2& map_from_base);
  /// A solid is elsewhere now.
  void Move(const MovedSolid& moved) { scene_.Move(moved); }
  /// Newest distance of each sensor [m], rounded to 1 cm, from 0.1 to 5, kNoEcho when none came.
  const std::array<double, kSonars>& ranges_m() const { return ranges_m_; }

 private:
  std::optional<double> Overheard(const Pose2& map_from_sonar, const std::vector<std::optional<Echo>>& echoes,
                                  int own);
  double Measured(const std::optional<double>& range_m);
  bool Has(int sensor, std::string_view kind) const;
  double DeafnessDb(int sensor) const;

  SonarConfig config_;
  Eigen::Vector2d footprint_m_;
  AcousticScene scene_;
  Rng rng_;
  double sound_speed_ratio_;
  std::array<double, kSonars> ranges_m_;
  std::vector<SonarFault> faults_;
};

}  // namespace priamos::world
