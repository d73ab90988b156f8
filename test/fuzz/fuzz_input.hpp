#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/schema.hpp"
#include "bus/type_files.hpp"
#include "lcmtypes/embedded_types.hpp"

namespace priamos::bus {

/// A broken promise: the fuzzer keeps the input.
inline void Require(bool promise) {
  if (!promise) std::abort();
}

/// Our types and the foreign ones of test/bus/schema.
inline const Schema& FuzzSchema() {
  static const Schema schema = [] {
    std::vector<Schema::Source> sources = ReadTypeFiles(PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign");
    for (const TypeText& text : EmbeddedTypes()) sources.push_back({text.file, text.text});
    return Schema(sources);
  }();
  return schema;
}

/// The first byte chooses a type, the rest is for it.
struct TypedInput {
  const Struct* type = nullptr;
  std::span<const std::byte> rest;
};

inline TypedInput SplitInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<const Struct*> types = FuzzSchema().All();
  const auto bytes = std::as_bytes(std::span(data, size));
  if (bytes.empty()) return {types[0], bytes};
  return {types[data[0] % types.size()], bytes.subspan(1)};
}

/// `body` with the fingerprint of `type` before it.
inline std::vector<std::byte> WithFingerprint(const Struct& type, std::span<const std::byte> body) {
  std::vector<std::byte> message(8 + body.size());
  WriteBigEndian(message.data(), type.fingerprint);
  std::copy(body.begin(), body.end(), message.begin() + 8);
  return message;
}

}  // namespace priamos::bus
