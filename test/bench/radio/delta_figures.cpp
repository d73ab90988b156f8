// What differences to an acknowledged baseline save, on a robot that drives, and on one that stands.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bus/schema/json.hpp"
#include "bus/schema/packing.hpp"
#include "bus/schema/schema.hpp"
#include "bus/type_files.hpp"
#include "figures.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bench {
namespace {

using namespace bus::radio;
using bus::Json;

/// A robot in a room, seen by noisy sensors: it drives a circle of 2 m radius, or stands.
class Robot {
 public:
  explicit Robot(double speed_m_s) : speed_m_s_(speed_m_s) {}
  Json Pose(double t_s) {
    const double angle = speed_m_s_ * t_s / kRadius_m, noise_m = 0.003;
    return {{"utime", ToUtime(FromUtime(0) + FromSeconds(t_s))},
            {"x_m", kRadius_m * std::cos(angle) + Noise(noise_m)},
            {"y_m", kRadius_m * std::sin(angle) + Noise(noise_m)},
            {"yaw_rad", std::remainder(angle + Noise(0.001), 2 * std::numbers::pi)},
            {"vx_m_s", speed_m_s_ + Noise(0.005)},
            {"vy_m_s", Noise(0.005)},
            {"wz_rad_s", speed_m_s_ / kRadius_m + Noise(0.005)}};
  }
  Json Sonars(double t_s) {
    const double angle = speed_m_s_ * t_s / kRadius_m;
    std::vector<double> ranges;
    for (int i = 0; i < 24; ++i) {
      // Walls of a room of 7 m x 7 m.
      const double beam = angle + i * std::numbers::pi / 12;
      const double x = kRadius_m * std::cos(angle), y = kRadius_m * std::sin(angle);
      const double to_x = (std::copysign(3.5, std::cos(beam)) - x) / std::cos(beam);
      const double to_y = (std::copysign(3.5, std::sin(beam)) - y) / std::sin(beam);
      ranges.push_back(std::min({to_x, to_y, 5.0}) + Noise(0.005));
    }
    return {{"utime", ToUtime(FromUtime(0) + FromSeconds(t_s))}, {"range_m", ranges}};
  }

 private:
  static constexpr double kRadius_m = 2;
  double Noise(double sigma) { return std::normal_distribution<>(0, sigma)(rng_.engine()); }
  double speed_m_s_;
  Rng rng_{1};
};

/// Mean bits of a message on the line, at 4 messages per second.
double MeanBits(const bus::Packer& packer, double speed_m_s, double frame_loss, bool deltas) {
  LinkPair pair;
  LinkChannel channel = TestChannels()[kPoseUp];
  channel.rate_hz = 0;
  // The messages of LinkPair are whole bytes: the fill counts as a value that never changes.
  channel.fixed_bits = channel.max_bits = static_cast<std::uint32_t>(8 * packer.MaxBytes());
  if (deltas) channel.delta = packer.ValueWidths();
  if (const auto fill = 8 * packer.MaxBytes() - packer.MaxBits(); deltas && fill > 0)
    channel.delta.push_back(static_cast<std::uint8_t>(fill));
  for (LinkPair::End* end : {&pair.onboard, &pair.offboard}) {
    end->channels[kPoseUp] = channel;
    pair.Start(*end);
  }
  Rng rng(2);
  pair.lose_up = pair.lose_down = [&](std::span<const std::byte>) { return rng.Chance(frame_loss); };
  Robot robot(speed_m_s);
  pair.each_step = [&] {
    if (ToUtime(pair.now) % 250'000 != 0) return;
    const double t_s = Seconds(pair.now - FromUtime(0));
    const bool pose = packer.type().name == "pose_velocity_t";
    const auto encoded = bus::FromJson(packer.type(), pose ? robot.Pose(t_s) : robot.Sonars(t_s));
    const std::int64_t sent_at = ToUtime(pair.now) + static_cast<std::int64_t>(rng.Below(100'000));
    pair.onboard.link->Offer(kPoseUp, packer.Pack(encoded, sent_at)->bytes, pair.now);
  };
  pair.Run(120);
  const QueueCounters& counters = pair.onboard.link->sent(kPoseUp);
  return static_cast<double>(counters.bits) / static_cast<double>(counters.sent);
}

}  // namespace

void Differences(Figures& figures) {
  Figures::Section("Differences to an acknowledged baseline: mean bits of a message, 4 per second");
  const bus::Schema schema(bus::ReadTypeFiles(std::string(PRIAMOS_SOURCE_DIR) + "/test/bench/radio"));
  for (const char* name : {"pose_velocity_t", "sonars_t"}) {
    const bus::Packer packer(*schema.Find(name));
    const double whole = MeanBits(packer, 0.3, 0, false);
    figures.Note(fmt::format("{}, whole", name), whole, "bit");
    for (const double speed : {0.0, 0.3})
      for (const double loss : {0.0, 0.1, 0.3})
        figures.AtMost(fmt::format("  difference at {:g} m/s, {:g} % of the frames lost", speed, 100 * loss),
                       whole, MeanBits(packer, speed, loss, true), "bit");
  }
}

}  // namespace priamos::bench
