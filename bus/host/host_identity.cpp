#include "bus/host/host_identity.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <string_view>

#include "common/text/text_hash.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kNameBytes = 64;  // @max of the messages that carry it

std::string BootId() {
  std::ifstream in("/proc/sys/kernel/random/boot_id");
  std::string id;
  in >> id;
  const auto allowed = [](char c) { return c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return id.size() <= 36 && std::all_of(id.begin(), id.end(), allowed) ? id : "";
}

}  // namespace

std::int32_t IdentityOf(std::string_view text) {
  return std::bit_cast<std::int32_t>(TextHash32(text));
}

HostIdentity ThisHost() {
  HostIdentity host;
  std::array<char, kNameBytes + 1> name{};
  host.name = gethostname(name.data(), kNameBytes) == 0 ? name.data() : "?";
  host.boot = BootId();
  struct stat network {};
  stat("/proc/self/ns/net", &network);
  host.network = network.st_ino;
  return host;
}

std::int32_t HostIdentity::IdAt(std::string_view address) const {
  return IdentityOf(fmt::format("{} {} {}", boot, network, address));
}

}  // namespace priamos::bus
