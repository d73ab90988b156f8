#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "bus/schema/schema.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {

/// Decodes an LCM message of type T. Throws std::runtime_error when `bytes` is not exactly one T.
template <class T>
T Decode(std::span<const std::byte> bytes) {
  T message{};
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size()))
    throw std::runtime_error("not decodable");
  return message;
}

/// The bytes of a message, fingerprint included.
template <class T>
std::vector<std::byte> Encode(const T& message) {
  std::vector<std::byte> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// The message of type T in bytes that anybody may have sent; nullopt when they are none. `schema` knows T.
template <class T>
std::optional<T> DecodeChecked(const Schema& schema, std::span<const std::byte> bytes) {
  const Struct* type = schema.Find(static_cast<std::uint64_t>(T::getHash()));
  if (type == nullptr || !Walk(*type, bytes)) return std::nullopt;
  return Decode<T>(bytes);
}

}  // namespace priamos::bus
