#include "bus/radio/message_codecs.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"

namespace priamos::bus::radio {
namespace {

/// The first field with `@age`; empty without one.
std::string StampFieldOf(const Struct& type) {
  for (const Field& field : type.fields)
    if (field.annotation.age_us && field.dims.empty()) return field.name;
  return {};
}

}  // namespace

MessageCodecs::MessageCodecs(const LinkConfig& config, const Schema& schema) {
  const ChannelTable table = config.Table(schema);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Struct* type = schema.Find(config.channels[i].type);
    codecs_.push_back(
        {type, Packer(*type), config.channels[i].key, StampFieldOf(*type), table.at(i).fixed_bits > 0});
  }
}

std::optional<Packed> MessageCodecs::Pack(std::size_t channel, std::span<const std::byte> encoded,
                                          Time now) const {
  const Codec& codec = codecs_[channel];
  auto result = codec.packer.Pack(encoded, ToUtime(now));
  if (!result || !result->refused.empty()) return std::nullopt;
  const std::size_t bits = codec.fixed ? codec.packer.MaxBits() : result->bytes.size() * 8;
  return Packed{std::move(result->bytes), bits, !result->saturated.empty()};
}

std::string MessageCodecs::RefusalOf(std::size_t channel, std::span<const std::byte> encoded,
                                     Time now) const {
  const Codec& codec = codecs_[channel];
  const auto result = codec.packer.Pack(encoded, ToUtime(now));
  if (!result) return fmt::format("expected a {}, got other bytes: not sent", codec.type->full_name);
  if (result->refused.empty()) return {};
  const PackedField& field = codec.packer.fields()[result->refused.front()];
  return fmt::format("{}.{}: expected {}, got a value outside: not sent", codec.type->full_name, field.name,
                     field.codes);
}

std::optional<std::vector<std::byte>> MessageCodecs::Unpack(const Delivery& delivery) const {
  return codecs_[delivery.channel].packer.Unpack(delivery.packed, ToUtime(delivery.packed_at));
}

std::optional<Time> MessageCodecs::StampOf(std::size_t channel, std::span<const std::byte> encoded) const {
  const Codec& codec = codecs_[channel];
  if (codec.stamp_field.empty()) return std::nullopt;
  try {
    const auto utime = ToJson(*codec.type, encoded).at(codec.stamp_field).get<std::int64_t>();
    return utime == 0 ? std::nullopt : std::optional(FromUtime(utime));
  } catch (const MessageError&) {
    return std::nullopt;  // no message of the type: refused when it is packed
  }
}

std::string MessageCodecs::KeyOf(std::size_t channel, std::span<const std::byte> encoded) const {
  const Codec& codec = codecs_[channel];
  if (codec.key_field.empty()) return {};
  try {
    const Json message = ToJson(*codec.type, encoded);
    return message.at(codec.key_field).dump();
  } catch (const MessageError&) {
    return {};  // no message of the type: refused when it is packed
  }
}

}  // namespace priamos::bus::radio
