#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bus/schema/pack_plan.hpp"

namespace priamos::bus {

/// A packed message, and which values could not be represented.
struct PackResult {
  std::vector<std::byte> bytes;  ///< empty when `refused` is not
  /// Fields with a value that was outside its `@range`, too old, too long or too many, each once: rows of
  /// Packer::fields(). Such a value is sent as the nearest one that can be represented.
  std::vector<std::uint16_t> saturated;
  /// The same of fields marked `@refuse` and of enumerations, for which there is no nearest value: with one
  /// of them the message must not be sent.
  std::vector<std::uint16_t> refused;
};

/// Turns encoded messages of one annotated type into as few bits as the annotations allow, and back. Byte
/// exact rules: README.md of this folder.
///
/// The Struct, hence its Schema, must outlive the Packer. All functions are const and may run in several
/// threads.
class Packer {
 public:
  /// Prepares packing of messages of `type`. Throws SchemaError, `file:line: type.field: ...`, when a field
  /// lacks what packing needs.
  explicit Packer(const Struct& type);

  const Struct& type() const { return *type_; }
  /// The bit table, in the order of the bits.
  const std::vector<PackedField>& fields() const { return fields_; }
  /// Bits of every value of a message, in their order. Only for types whose messages all have the same size:
  /// fixed arrays, no texts; throws std::logic_error for others.
  std::vector<std::uint8_t> ValueWidths() const;
  /// Most bits and bytes of a packed message.
  std::size_t MaxBits() const { return max_bits_; }
  std::size_t MaxBytes() const { return (max_bits_ + 7) / 8; }

  /// Packs an encoded message. `now_us` is the time of sending [us]: time stamps travel as their age then.
  /// nullopt when Walk refuses the encoded message.
  std::optional<PackResult> Pack(std::span<const std::byte> encoded, std::int64_t now_us) const;

  /// The encoded message, with time stamps in the receiver's clock: `now_us` is when it was received (less
  /// the transmission time, where that is known). nullopt when the bits are no packed message of the type,
  /// which has exactly packed.size() bytes. What comes out passes Walk.
  std::optional<std::vector<std::byte>> Unpack(std::span<const std::byte> packed, std::int64_t now_us) const;
  /// Unpacks the message at the beginning of `packed` as Unpack does and removes its bytes from `packed`.
  std::optional<std::vector<std::byte>> UnpackFront(std::span<const std::byte>& packed,
                                                    std::int64_t now_us) const;

 private:
  const Struct* type_;
  std::vector<PackedField> fields_;
  std::shared_ptr<const PackPlan> plan_;
  std::size_t max_bits_ = 0;
};

/// The bit table as text for a terminal, with the sum.
std::string FormatBitTable(const Packer& packer);

}  // namespace priamos::bus
