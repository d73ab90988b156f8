#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/pilot/pilot_config.hpp"
#include "common/pilot/stick.hpp"
#include "common/time.hpp"
#include "console/core/browser_message.hpp"

namespace priamos::console {

/// A page that is connected; never used twice.
using ClientId = std::uint64_t;

/// Several pages, one stick: whose hand is on it, and what the pilot sees of it. Pure: time is an argument.
///
/// A page that holds something gets the free seat; it is free again when the hand has rested for kRelease, or
/// is gone. A taken one needs the take-over button. A page moves nothing before it has once reported a hand
/// that holds nothing: after it connected, after it was silent while it held something, after a stop, and
/// when it takes over.
class Seat {
 public:
  static constexpr Duration kRelease{2'000'000};
  static constexpr Duration kSilence{300'000};  ///< a hand that holds something reports at 20 Hz and more

  /// `freshness`: a report that is proven no younger is not obeyed, and moves nothing once it has become so
  /// old.
  Seat(const PilotConfig& pilot, Duration freshness)
      : buttons_(pilot.buttons), freshness_(freshness), silence_(FromSeconds(pilot.silence_s)) {}

  void Join(ClientId client) { pages_.try_emplace(client); }
  void Leave(ClientId client);
  /// A report that is at most `age` old; false when that is too old.
  bool Take(ClientId client, const StickReport& report, Duration age, Time now);
  /// Ends the drive of whoever drives.
  void End();

  /// What the pilot sees; to be called once per step, for short presses are shown once.
  Stick Look(Time now);

  std::optional<ClientId> holder() const { return holder_; }

 private:
  struct Page {
    bool has_let_go = false;
  };
  void Free();
  bool MayTakeOver(const StickReport& report) const { return !holder_ || report.take_over; }
  std::uint32_t Held(const StickReport& report) const;
  std::uint32_t Pressed(const StickReport& report) const;

  ButtonUse buttons_;
  Duration freshness_, silence_;
  std::map<ClientId, Page> pages_;
  std::optional<ClientId> holder_;
  StickReport report_;     ///< newest one of the holder
  Time heard_{}, busy_{};  ///< when it came, or so much earlier that the pilot knows its age; when the hand
                           ///< last held something
  std::uint32_t presses_ = 0;  ///< buttons that were pressed since the last look
  bool hidden_ = false;        ///< the next look shows no stick: the drive before is over
};

}  // namespace priamos::console
