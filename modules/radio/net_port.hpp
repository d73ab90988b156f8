#pragma once

#include <memory>
#include <string>

#include "radio/net_frame.hpp"

namespace priamos::radio {

/// True for what begins with "udp:" or "tcp:".
bool IsNetPort(const std::string& port);

/// Reads a port of the forms of NetAddress. Throws ConfigError with one sentence that shows them; `place` is
/// where the port stands, `file:line:key`.
NetAddress ParseNetAddress(const std::string& port, const std::string& place = "port");

/// UDP: what is written is put together to frames, up to and with the zero byte, and each goes as one
/// datagram. Datagrams without a receiver are lost. TCP: a stream of bytes; written without a connection they
/// are lost, as on a radio. Never blocks; names are looked up when it is opened. Throws std::runtime_error
/// with one sentence when the port is taken or the host unknown.
std::unique_ptr<NetPort> OpenNetPort(const NetAddress& address);

}  // namespace priamos::radio
