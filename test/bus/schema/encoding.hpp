#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/schema.hpp"

/// Encoded messages for tests: from generated types, or byte by byte.
namespace priamos::bus {

using Bytes = std::vector<std::byte>;

template <class T>
Bytes Encode(const T& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  if (message.encode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size())) {
    throw std::runtime_error("lcm-gen's encoder failed");
  }
  return bytes;
}

template <class T>
T Decode(std::span<const std::byte> bytes) {
  T message;
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size())) {
    throw std::runtime_error("lcm-gen's decoder failed");
  }
  return message;
}

/// Puts a message together number by number: what no encoder would write can be written.
class MessageBuilder {
 public:
  explicit MessageBuilder(const Struct& type) { Put(type.fingerprint); }
  template <class T>
  MessageBuilder& Put(T number) {
    bytes_.resize(bytes_.size() + sizeof(T));
    WriteBigEndian(bytes_.data() + bytes_.size() - sizeof(T), number);
    return *this;
  }
  MessageBuilder& Text(const std::string& text) {
    Put(static_cast<std::int32_t>(text.size() + 1));
    for (const char c : text) Put(c);
    return Put('\0');
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

inline Schema SchemaOf(const std::string& text) {
  return Schema({{"t.lcm", text}});
}

}  // namespace priamos::bus
