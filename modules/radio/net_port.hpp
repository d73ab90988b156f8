#pragma once

#include <memory>
#include <string>

#include "common/serial_port.hpp"

namespace priamos::radio {

/// A link that is IP but thin. HOST is a name or an address (IPv6 in brackets); such a port is written
/// - `udp:HOST:PORT`: datagrams to and from HOST:PORT; bound to PORT here, too
/// - `udp:HOST:PORT@LOCAL`: the same, bound to port LOCAL here
/// - `tcp:HOST:PORT`: connects, and again when the connection is lost
/// - `tcp::PORT`: waits for one to connect; a new connection replaces the old one
struct NetAddress {
  bool datagrams = false;
  std::string host;  ///< empty: wait for a connection
  std::string port;
  std::string local_port;
  bool loopback_only = false;  ///< who waits is heard by this machine alone
};

/// True for what begins with "udp:" or "tcp:".
bool IsNetPort(const std::string& port);

/// Reads a port of the forms of NetAddress. Throws ConfigError with one sentence that shows them.
NetAddress ParseNetAddress(const std::string& port);

/// UDP: what is written is put together to frames, up to and with the zero byte, and each goes as one
/// datagram; a datagram that arrives is read with a zero at its end. Datagrams without a receiver are lost.
/// TCP: a stream of bytes; written without a connection they are lost, as on a radio. Never blocks; names are
/// looked up when it is opened. Throws std::runtime_error with one sentence when the port is taken or the
/// host unknown.
std::unique_ptr<ByteStream> OpenNetPort(const NetAddress& address);

}  // namespace priamos::radio
