#include "radio/net_port.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "common/config.hpp"
#include "common/input/quoted.hpp"
#include "common/text/number_text.hpp"
#include "radio/net_socket.hpp"

namespace priamos::radio {
namespace {

bool IsPortNumber(const std::string& text) {
  return text.size() <= 5 && NumberOf<std::uint16_t>(text);
}

}  // namespace

bool IsNetPort(const std::string& port) {
  return port.rfind("udp:", 0) == 0 || port.rfind("tcp:", 0) == 0;
}

NetAddress ParseNetAddress(const std::string& port, const std::string& place) {
  const auto refuse = [&] {
    throw ConfigError(
        fmt::format("{}: expected udp:HOST:PORT, udp:HOST:PORT@LOCAL, tcp:HOST:PORT or tcp::PORT, got {}",
                    place, Quoted(port)));
  };
  NetAddress address;
  address.datagrams = port.rfind("udp:", 0) == 0;
  const std::string rest = port.substr(4);
  const std::size_t colon = rest.rfind(':'), at = rest.find('@');
  if (!IsNetPort(port) || colon == std::string::npos) refuse();
  address.host = rest.substr(0, colon);
  address.port = rest.substr(colon + 1, at == std::string::npos ? at : at - colon - 1);
  address.local_port = at == std::string::npos ? address.port : rest.substr(at + 1);
  if (address.host.size() > 1 && address.host.front() == '[' && address.host.back() == ']')
    address.host = address.host.substr(1, address.host.size() - 2);
  if (!IsPortNumber(address.port) || !IsPortNumber(address.local_port)) refuse();
  if (address.datagrams && address.host.empty()) refuse();
  if (!address.datagrams && at != std::string::npos) refuse();
  return address;
}

std::unique_ptr<NetPort> OpenNetPort(const NetAddress& address) {
  return address.datagrams ? OpenUdpPort(address) : OpenTcpPort(address);
}

}  // namespace priamos::radio
