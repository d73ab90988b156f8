#include "bus/radio/channels/frames_ahead.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus::radio {

double FramesAhead(std::vector<Ahead> ahead, double room_bits) {
  std::sort(ahead.begin(), ahead.end(), [](const Ahead& a, const Ahead& b) { return a.entries > b.entries; });
  double entries = 0;
  double bits = 0;
  for (const Ahead& a : ahead) {
    entries += a.entries;
    bits += a.bits;
  }
  double frames = room_bits > 0 ? std::min(entries, std::floor(bits / room_bits)) : entries;
  // The most frequent ones first: without them least is left to count.
  for (const Ahead& a : ahead) {
    if (a.most_bits >= room_bits) continue;
    room_bits -= a.most_bits;
    entries -= a.entries;
    bits -= a.bits;
    frames = std::min({frames, entries, std::floor(bits / room_bits)});
  }
  return frames;
}

}  // namespace priamos::bus::radio
