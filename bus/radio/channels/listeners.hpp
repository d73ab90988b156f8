#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "bus/radio/channels/bundle.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// Which on-request channels have listeners: here, as this end reports to the other one; and at the other
/// end, whose report counts for some seconds.
class Listeners {
 public:
  /// Whether somebody listens here to a channel of the other end.
  void Listen(std::size_t channel, bool listening);
  /// Whether the listeners here have changed since the last report.
  bool changed() const { return changed_; }
  /// Whether a report to the other end is due: after a change, and now and then.
  bool Due(Time now) const;
  /// The report; it counts as sent.
  ListenEntry Take(Time now);
  /// Makes the report due again, because the frame with it was cut off.
  void Return() { changed_ = true; }

  /// Takes the other end's report.
  void OnListen(const ListenEntry& listen, Time now);
  /// Whether the other end has been silent about its listeners for too long: none is believed to be
  /// there any more. True once.
  bool TakeExpiry(Time now);

 private:
  std::uint64_t here_ = 0;  ///< bit i: channel i has a listener here
  bool changed_ = false;
  std::optional<Time> sent_at_;
  std::optional<Time> believed_until_;
};

}  // namespace priamos::bus::radio
