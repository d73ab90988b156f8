// Forged, mutated, replayed and damaged frames.
#include "figures.hpp"
#include "test/bus/radio/measurement/attack_measurement.hpp"

namespace priamos::bench {

using namespace bus::radio;

void Hostile(Figures& figures, const Effort& effort) {
  Figures::Section("Forged, mutated, replayed, reflected frames");
  std::uint64_t tried = 0, accepted = 0, delivered = 0, flooded = 0;
  int alarms = 0, heard = 0;
  for (const Boot boot : {Boot::kSame, Boot::kLater, Boot::kLaterForgot}) {
    const Attack attack = AttackReceiver(boot, 7, 340'000);
    tried += attack.tried;
    accepted += attack.accepted;
    delivered += attack.delivered;
    flooded += attack.flooded;
    alarms += attack.alarm ? 1 : 0;
    heard += attack.still_works ? 1 : 0;
  }
  figures.AtLeast("tried: same boot, later boot, later boot without memory", 1e6, static_cast<double>(tried),
                  "frames");
  figures.Note("of them not looked at, because faster than the line", static_cast<double>(flooded), "");
  figures.Exactly("accepted", 0, static_cast<double>(accepted), "frames");
  figures.Exactly("messages delivered", 0, static_cast<double>(delivered), "");
  figures.Exactly("alarm raised", 3, alarms, "of 3");
  figures.Exactly("the true other end is heard again within 1 s", 3, heard, "of 3");

  Figures::Section("Damaged frames: bit errors, bursts, doubled bytes; both directions");
  DamagedFrames sum;
  for (const double rate : {1e-5, 1e-4, 1e-3}) {
    const DamagedFrames part = SendDamagedFrames(rate, 11, effort.long_run ? 3'400'000 : 100'000);
    sum.sent += part.sent;
    sum.rejected += part.rejected;
    sum.delivered += part.delivered;
    sum.wrong += part.wrong;
  }
  figures.AtLeast("frames sent", effort.long_run ? 1e7 : 3e5, static_cast<double>(sum.sent), "");
  figures.Note("refused pieces", static_cast<double>(sum.rejected), "");
  figures.Note("messages delivered", static_cast<double>(sum.delivered), "");
  figures.Exactly("wrong messages delivered", 0, static_cast<double>(sum.wrong), "");
}

}  // namespace priamos::bench
