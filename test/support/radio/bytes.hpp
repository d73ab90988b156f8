#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace priamos::support {

/// Bytes with these values.
inline std::vector<std::byte> Bytes(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
  return bytes;
}

}  // namespace priamos::support
