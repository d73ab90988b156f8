#pragma once

#include <memory>
#include <string>

#include "common/serial_port.hpp"
#include "radio/net_frame.hpp"

namespace priamos::radio {

/// True for `kiss:TTY`: a packet radio (TNC) at a serial port, which takes and gives packets in KISS.
bool IsKissPort(const std::string& port);

/// The TTY of a `kiss:TTY`.
std::string TtyOf(const std::string& port);

/// A packet radio: what is written is put together to frames, up to and with the zero byte, and each goes as
/// one packet, without that byte. What the serial port does not take is kept for it, but no packet behind one
/// that waits: it would come too late.
std::unique_ptr<NetPort> OpenKissPort(std::unique_ptr<ByteStream> serial);

}  // namespace priamos::radio
