#include "world/core/scene/camera_quirks.hpp"

#include "common/random.hpp"

namespace priamos::world {

void CameraQuirksPlan::Describe(Archive& a) {
  a.Number("gain_spread", gain_spread, {"-", 0, 0.8, "each camera's gain is off by up to this part"});
  a.Number("gain_drift", gain_drift, {"-", 0, 0.3, "and wanders by this part, one sigma"});
  a.Number("gain_drift_s", gain_drift_s, {"s", 1, 10000, "time after which it has forgotten where it was"});
  a.Number("defocus_dioptre", defocus_dioptre, {"1/m", 0, 3, "each lens is set wrong by up to this"});
  a.Number("decentring", decentring, {"-", 0, 0.01, "p1 and p2 of each lens (Brown 1966), up to this"});
  a.Number("k3", k3, {"-", 0, 0.3, "radial distortion of seventh order, up to this"});
}

CameraQuirks DrawQuirks(const CameraQuirksPlan& plan, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "camera quirks");
  const auto within = [&rng](double bound) { return rng.Uniform(-1, 1) * bound; };
  CameraQuirks quirks;
  for (CameraQuirk& camera : quirks.cameras)
    camera = {1 + within(plan.gain_spread), within(plan.defocus_dioptre), within(plan.decentring),
              within(plan.decentring), within(plan.k3)};
  quirks.gain_drift = plan.gain_drift;
  quirks.gain_drift_s = plan.gain_drift_s;
  return quirks;
}

HeadBuild WithQuirks(HeadBuild head, const CameraQuirks& quirks) {
  for (std::size_t i = 0; i < kCameras; ++i) {
    head.cameras[i].p1 += quirks.cameras[i].p1;
    head.cameras[i].p2 += quirks.cameras[i].p2;
    head.cameras[i].k3 += quirks.cameras[i].k3;
  }
  return head;
}

}  // namespace priamos::world
