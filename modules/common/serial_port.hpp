#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace priamos {

/// Bytes in both directions: a serial port, an emulated line, a socket. Never blocks.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// Reads what is there, at most `into.size()` bytes; 0 when there is nothing now.
  virtual std::size_t Read(std::span<std::byte> into) = 0;
  /// Writes as many of `bytes` as are taken now, from the first on, and returns their number.
  virtual std::size_t Write(std::span<const std::byte> bytes) = 0;
};

/// Opens a tty raw, 8N1, no flow control, and clears what its buffers held. Throws std::runtime_error with
/// one sentence that names the next step when `path` is absent, is no tty, is held by another process, may
/// not be opened, or cannot run at `baud`. A port that is pulled out later is silent, and is opened again
/// when there is one under its name. Reading or writing throws for any other error.
std::unique_ptr<ByteStream> OpenSerialPort(const std::string& path, int baud);

/// Why no serial port runs at `baud`, with the rates there are; empty when it is one of these.
std::string SerialRateProblem(int baud);

}  // namespace priamos
