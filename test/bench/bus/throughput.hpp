#pragma once

#include <cstddef>
#include <cstdint>

namespace priamos::bench {

/// What became of messages that were sent as fast as the kernel takes them.
struct Throughput {
  std::uint64_t sent = 0, heard = 0, lost = 0;  ///< lost: as the receiving bus reports it
  double seconds = 0;                           ///< of sending
};

/// Sends messages of so many bytes from one thread for so long; another thread receives them.
Throughput SendFlatOut(std::size_t bytes, double seconds);

}  // namespace priamos::bench
