#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bus/radio/link_config.hpp"
#include "bus/radio/message_receiver.hpp"
#include "bus/radio/message_sender.hpp"
#include "bus/schema/packing.hpp"

namespace priamos::bus::radio {

/// Packing and unpacking of the LCM messages of a link's channels, for types known from .lcm texts only.
class MessageCodecs {
 public:
  /// Codecs of all channels of `config`. `schema` must outlive them and know the types of `config`, which
  /// LinkConfig::Table checks.
  MessageCodecs(const LinkConfig& config, const Schema& schema);

  /// Packs an encoded message of a channel at the time of sending `now`; nullopt if it is no message of the
  /// channel's type, or has a value out of range in a field that refuses such values.
  std::optional<Packed> Pack(std::size_t channel, std::span<const std::byte> encoded, Time now) const;
  /// Why Pack refuses a message, one sentence; empty when it does not.
  std::string RefusalOf(std::size_t channel, std::span<const std::byte> encoded, Time now) const;
  /// The LCM message; nullopt when the other end sent something else.
  std::optional<std::vector<std::byte>> Unpack(const Delivery& delivery) const;
  /// The moment that the message's own time stamp (the first field with `@age`) tells; nullopt without one,
  /// when it is 0, and for what is no message of the type.
  std::optional<Time> StampOf(std::size_t channel, std::span<const std::byte> encoded) const;
  /// Value of the key field: messages with different keys do not replace each other. Empty without a key
  /// field.
  std::string KeyOf(std::size_t channel, std::span<const std::byte> encoded) const;

 private:
  struct Codec {
    const Struct* type;
    Packer packer;
    std::string key_field, stamp_field;
    bool fixed;
  };
  std::vector<Codec> codecs_;
};

}  // namespace priamos::bus::radio
