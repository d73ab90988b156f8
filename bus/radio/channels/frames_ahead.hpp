#pragma once

#include <limits>
#include <vector>

namespace priamos::bus::radio {

/// Messages of one channel, or acknowledgements, that go before a message that waits.
struct Ahead {
  double entries = 0;
  double bits = 0;
  /// Bits that one frame has of them at most, however many come: of a channel of which the newest message
  /// alone waits.
  double most_bits = std::numeric_limits<double>::infinity();
};

/// Number of frames, at most, that leave a message out because of what is ahead: each has at least one entry
/// of it, and at least `room_bits` bits when that is more than 0. What a frame has a limited number of bits
/// of need not be counted, however often it comes, as long as that does not fill a frame: each of these must
/// have something else beside it.
double FramesAhead(std::vector<Ahead> ahead, double room_bits);

}  // namespace priamos::bus::radio
