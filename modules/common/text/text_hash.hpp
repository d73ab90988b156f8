#pragma once

#include <cstdint>
#include <string_view>

namespace priamos {

/// A number for a text, the same on every machine and in every build, which std::hash is not: FNV-1a (Fowler,
/// Noll and Vo; draft-eastlake-fnv), 32 bits. Not for secrets: others find texts of the same number easily.
constexpr std::uint32_t TextHash32(std::string_view text) {
  std::uint32_t hash = 0x811c9dc5U;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x01000193U;
  return hash;
}

/// As TextHash32, 64 bits.
constexpr std::uint64_t TextHash64(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace priamos
