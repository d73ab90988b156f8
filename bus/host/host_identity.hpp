#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace priamos::bus {

/// Which computer this is, as far as a bus is concerned.
struct HostIdentity {
  std::string name;  ///< as people call it; two computers may have the same
  std::string boot;  ///< drawn by the kernel when the computer was switched on; empty when it cannot be read
  std::uint64_t network = 0;  ///< number of its network namespace; an ordinary one has the same everywhere

  /// Names it on a bus to which it sends from the IPv4 `address`: the same in all its processes there. A
  /// virtual machine that was copied while it ran has the boot and the network of the other one; its address
  /// is its own.
  std::int32_t IdAt(std::string_view address) const;
};

/// A number that stands for `text`; two texts have the same once in 4 thousand million.
std::int32_t IdentityOf(std::string_view text);

/// The computer, and the network namespace, in which this process runs.
HostIdentity ThisHost();

}  // namespace priamos::bus
