#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace priamos::bus {

/// Which computer this is, as far as a bus is concerned.
struct HostIdentity {
  std::string name;  ///< as people call it; two computers may have the same
  std::string boot;  ///< drawn by the kernel when the computer was switched on; empty when it cannot be read
  std::int32_t id =
      0;  ///< from `boot` and the network namespace: the same in all processes that share a network
};

/// A number that stands for `text`; two texts have the same once in 4 thousand million.
std::int32_t IdentityOf(std::string_view text);

/// The computer, and the network namespace, in which this process runs.
HostIdentity ThisHost();

}  // namespace priamos::bus
