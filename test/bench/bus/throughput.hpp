#pragma once

#include <cstddef>
#include <cstdint>

namespace priamos::bench {

/// What became of messages that were sent as fast as the kernel takes them.
struct Throughput {
  std::uint64_t sent = 0, heard = 0;
  std::uint64_t lost = 0;  ///< as the receiving bus reports it; raw sockets report nothing
  double seconds = 0;      ///< of sending
};

/// Sends messages of so many bytes from one thread for so long; another thread receives them.
Throughput SendFlatOut(std::size_t bytes, double seconds);

/// The same with bare sockets: datagrams of so many bytes to a group, into which nobody looks. What the
/// kernel of this machine can do.
Throughput SendRawFlatOut(std::size_t bytes, double seconds);

}  // namespace priamos::bench
