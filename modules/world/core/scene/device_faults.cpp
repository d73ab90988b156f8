#include "world/core/scene/device_faults.hpp"

#include <algorithm>

#include "common/sonar_ring.hpp"

namespace priamos::world {
namespace {

const std::vector<std::string>& Wheels() {
  static const std::vector<std::string> kWheels{"front_left", "front_right", "rear_left", "rear_right"};
  return kWheels;
}

constexpr double kLongest_s = 3600;

}  // namespace

void SonarFault::Describe(Archive& a) {
  a.Integer("sensor", sensor,
            {"-", kAny, kSonars, "S1 ahead, counter-clockwise; 0: any, drawn from the seed"});
  a.Choice("kind", kind, {"dead", "deaf", "stuck"},
           "dead: no echo ever; deaf: hears deaf_db less; stuck: repeats what it measured last");
  a.Number("at_s", at_s, {"s", 0, kLongest_s, "when it breaks, since the world began"});
  a.Number("deaf_db", deaf_db, {"dB", 1, 120, "what a deaf one hears less"});
  a.Number("chance", chance, {"-", 0, 1, "it breaks in this part of the runs, drawn from the seed"});
}

void MotorFault::Describe(Archive& a) {
  a.Choice("wheel", wheel, Wheels(), "which wheel");
  a.Choice("kind", kind, {"stalled", "loose"},
           "stalled: motor and wheel stand, the encoder with them; loose: the coupling slips, motor and "
           "encoder turn, the wheel rolls free");
  a.Number("at_s", at_s, {"s", 0, kLongest_s, "when it breaks, since the world began"});
}

std::size_t MotorFault::index() const {
  return static_cast<std::size_t>(std::find(Wheels().begin(), Wheels().end(), wheel) - Wheels().begin());
}

void MastPlan::Describe(Archive& a) {
  a.Number("nod_deg_s2_m", nod_deg_s2_m,
           {"deg s^2/m", 0, 5, "how far the mast leans per acceleration, against it"});
  a.Number("frequency_hz", frequency_hz, {"Hz", 0.5, 30, "of its swinging"});
  a.Number("damping", damping, {"-", 0.005, 1, "damping ratio of its swinging"});
}

void FaultsPlan::Describe(Archive& a) {
  a.List("sonars", sonars, "sensors of the ring that break");
  a.List("motors", motors, "drives that break");
}

}  // namespace priamos::world
