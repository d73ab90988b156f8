#include "bus/schema/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "bus/schema/big_endian.hpp"
#include "bus/schema/bit_stream.hpp"
#include "bus/schema/walk.hpp"

namespace priamos::bus {
namespace {

/// Hull of both directions: walks the plan, keeps the counts, and calls Direction::Value for every value.
/// Elements beyond the count that is packed are there to be read over only (`kept` is false).
template <class Direction>
class Traversal {
 public:
  bool Body(const PackPlan& plan, bool kept) {
    const std::size_t first = counts_.size();
    counts_.resize(first + plan.counts);
    for (const PackStep& step : plan.steps) {
      if (!Level(step, 0, first, kept)) return false;
    }
    counts_.resize(first);
    return true;
  }

 protected:
  /// How many elements the message has, and how many of them are packed.
  struct Count {
    std::int64_t present = 0;
    std::int64_t kept = 0;
  };

  Count& CountNumber(std::size_t number, std::size_t first) { return counts_[first + number]; }

 private:
  bool Level(const PackStep& step, std::size_t level, std::size_t first, bool kept) {
    if (level == step.dims.size()) return static_cast<Direction*>(this)->Value(step, first, kept);
    const std::int64_t dim = step.dims[level];
    const Count count = dim >= 0 ? Count{dim, dim} : CountNumber(static_cast<std::size_t>(-1 - dim), first);
    for (std::int64_t i = 0; i < count.present; ++i) {
      if (!Level(step, level + 1, first, kept && i < count.kept)) return false;
    }
    return true;
  }

  std::vector<Count> counts_;
};

class PackTraversal : public Traversal<PackTraversal> {
 public:
  PackTraversal(const std::byte* body, std::int64_t now_us, std::size_t max_bytes)
      : at_(body), now_us_(now_us), bits_(max_bytes) {}

  PackResult Finish() {
    if (!refused_.empty()) return {{}, std::move(saturated_), std::move(refused_)};
    return {bits_.Finish(), std::move(saturated_), {}};
  }

  bool Value(const PackStep& step, std::size_t first, bool kept) {
    if (const auto* real = std::get_if<RealCode>(&step.code)) {
      PutReal(step, *real, TakeReal(step.kind), kept);
    } else if (const auto* integer = std::get_if<IntegerCode>(&step.code)) {
      Put(step, integer->Encode(TakeInteger(step.kind)), kept);
    } else if (const auto* age = std::get_if<AgePack>(&step.code)) {
      Put(step, age->code.EncodeUp(AgeOf(TakeInteger(step.kind))), kept);
    } else if (const auto* count = std::get_if<CountPack>(&step.code)) {
      const std::int64_t present = TakeInteger(step.kind);
      const Coded coded = count->code.Encode(present);
      CountNumber(count->number, first) = {present, count->code.Decode(coded.code)};
      Put(step, coded, kept);
    } else if (const auto* text = std::get_if<TextPack>(&step.code)) {
      PutText(step, *text, kept);
    } else if (const auto* nested = std::get_if<StructPack>(&step.code)) {
      return Body(*nested->plan, kept);
    } else {
      Put(step, {TakeInteger(step.kind) != 0 ? 1U : 0U, false}, kept);
    }
    return true;
  }

 private:
  void Put(const PackStep& step, const Coded& coded, bool kept) {
    if (!kept) return;
    bits_.Put(coded.code, step.bits);
    if (coded.saturated) Report(step);
  }

  /// What is no number has no nearest value; a NaN may be the one that means "none".
  void PutReal(const PackStep& step, const RealCode& real, double value, bool kept) {
    const Coded coded = real.Encode(value);
    const bool none = std::isnan(value) && !coded.saturated;
    if (kept && !std::isfinite(value) && !none) return Report(step, refused_);
    Put(step, coded, kept);
  }

  void Report(const PackStep& step) { Report(step, step.refuse ? refused_ : saturated_); }

  static void Report(const PackStep& step, std::vector<std::uint16_t>& rows) {
    const auto row = static_cast<std::uint16_t>(step.row);
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
  }

  void PutText(const PackStep& step, const TextPack& text, bool kept) {
    const auto size = static_cast<std::int64_t>(ReadBigEndian<std::int32_t>(at_)) - 1;
    const std::byte* characters = at_ + 4;
    at_ += 4 + size + 1;
    if (!kept) return;
    std::int64_t length = std::min(size, text.max_length);
    if (length < size) {
      // Not in the middle of an UTF-8 sequence, if it is UTF-8.
      std::int64_t cut = length;
      while (cut > 0 && length - cut < 3 && (characters[cut] & std::byte{0xc0}) == std::byte{0x80}) --cut;
      if ((characters[cut] & std::byte{0xc0}) != std::byte{0x80}) length = cut;
      Report(step);
    }
    bits_.Put(static_cast<std::uint64_t>(length), text.length_bits);
    for (std::int64_t i = 0; i < length; ++i) {
      auto c = std::to_integer<std::uint64_t>(characters[i]);
      if (text.char_bits == 7 && c > 127) {
        c = '?';
        Report(step);
      }
      bits_.Put(c, text.char_bits);
    }
  }

  std::int64_t AgeOf(std::int64_t stamp_us) const {
    std::int64_t age = 0;
    if (!__builtin_sub_overflow(now_us_, stamp_us, &age)) return age;
    return stamp_us < 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
  }

  std::int64_t TakeInteger(Kind kind) {
    const std::size_t size = WireSize(kind);
    at_ += size;
    return kind == Kind::kByte ? std::to_integer<std::int64_t>(at_[-1]) : ReadInteger(at_ - size, size);
  }

  double TakeReal(Kind kind) {
    const std::size_t size = WireSize(kind);
    at_ += size;
    return kind == Kind::kFloat ? static_cast<double>(ReadBigEndian<float>(at_ - size))
                                : ReadBigEndian<double>(at_ - size);
  }

  const std::byte* at_;
  std::int64_t now_us_;
  BitWriter bits_;
  std::vector<std::uint16_t> saturated_;
  std::vector<std::uint16_t> refused_;
};

class UnpackTraversal : public Traversal<UnpackTraversal> {
 public:
  UnpackTraversal(std::uint64_t fingerprint, std::span<const std::byte> packed, std::int64_t now_us)
      : bits_(packed), now_us_(now_us) {
    bytes_.reserve(8 + 8 * packed.size());
    Append(fingerprint);
  }

  /// The bytes used, when the rest of the last one is zero; else nullopt.
  std::optional<std::size_t> Used() const {
    if (!bits_.ok() || !bits_.FillIsZero()) return std::nullopt;
    return bits_.bytes_used();
  }
  std::vector<std::byte> Finish() { return std::move(bytes_); }

  bool Value(const PackStep& step, std::size_t first, bool /*kept*/) {
    if (const auto* nested = std::get_if<StructPack>(&step.code)) return Body(*nested->plan, true);
    const std::uint64_t code = bits_.Get(step.bits);
    if (!bits_.ok()) return false;
    if (const auto* real = std::get_if<RealCode>(&step.code)) {
      if (code > real->last()) return false;
      const double value = real->Decode(code);
      step.kind == Kind::kFloat ? Append(static_cast<float>(value)) : Append(value);
    } else if (const auto* integer = std::get_if<IntegerCode>(&step.code)) {
      if (code > integer->last()) return false;
      AppendInteger(step.kind, integer->Decode(code));
    } else if (const auto* age = std::get_if<AgePack>(&step.code)) {
      if (code > age->code.last()) return false;
      AppendInteger(step.kind, StampOf(age->code.Decode(code)));
    } else if (const auto* count = std::get_if<CountPack>(&step.code)) {
      if (code > count->code.last()) return false;
      const std::int64_t n = count->code.Decode(code);
      CountNumber(count->number, first) = {n, n};
      AppendInteger(step.kind, n);
    } else if (const auto* text = std::get_if<TextPack>(&step.code)) {
      return Text(*text, static_cast<std::int64_t>(code));
    } else {
      AppendInteger(step.kind, static_cast<std::int64_t>(code));
    }
    return true;
  }

 private:
  bool Text(const TextPack& text, std::int64_t length) {
    if (length > text.max_length) return false;
    Append(static_cast<std::int32_t>(length + 1));
    for (std::int64_t i = 0; i < length; ++i)
      bytes_.push_back(static_cast<std::byte>(bits_.Get(text.char_bits)));
    bytes_.push_back(std::byte{0});
    return bits_.ok();
  }

  std::int64_t StampOf(std::int64_t age_us) const {
    std::int64_t stamp = 0;
    return __builtin_sub_overflow(now_us_, age_us, &stamp) ? std::numeric_limits<std::int64_t>::min() : stamp;
  }

  template <class T>
  void Append(T value) {
    bytes_.resize(bytes_.size() + sizeof(T));
    WriteBigEndian(bytes_.data() + bytes_.size() - sizeof(T), value);
  }

  void AppendInteger(Kind kind, std::int64_t value) {
    const std::size_t size = WireSize(kind);
    bytes_.resize(bytes_.size() + size);
    WriteInteger(bytes_.data() + bytes_.size() - size, value, size);
  }

  BitReader bits_;
  std::int64_t now_us_;
  std::vector<std::byte> bytes_;
};

void AppendWidths(const PackPlan& plan, std::vector<std::uint8_t>& widths) {
  for (const PackStep& step : plan.steps) {
    std::int64_t values = 1;
    bool fixed = !std::holds_alternative<TextPack>(step.code);
    for (const std::int64_t dim : step.dims) {
      fixed = fixed && dim >= 0;
      values *= dim;
    }
    if (!fixed) throw std::logic_error("values of a type without fixed size have no fixed widths");
    const auto* nested = std::get_if<StructPack>(&step.code);
    for (std::int64_t i = 0; i < values; ++i)
      nested != nullptr ? AppendWidths(*nested->plan, widths)
                        : widths.push_back(static_cast<std::uint8_t>(step.bits));
  }
}

}  // namespace

Packer::Packer(const Struct& type) : type_(&type), plan_(MakePackPlan(type, fields_)) {
  for (const PackedField& field : fields_) max_bits_ += static_cast<std::size_t>(field.bits * field.values);
}

std::vector<std::uint8_t> Packer::ValueWidths() const {
  std::vector<std::uint8_t> widths;
  AppendWidths(*plan_, widths);
  return widths;
}

std::optional<PackResult> Packer::Pack(std::span<const std::byte> encoded, std::int64_t now_us) const {
  if (!Walk(*type_, encoded)) return std::nullopt;
  PackTraversal traversal(encoded.data() + 8, now_us, MaxBytes());
  traversal.Body(*plan_, true);
  return traversal.Finish();
}

std::optional<std::vector<std::byte>> Packer::UnpackFront(std::span<const std::byte>& packed,
                                                          std::int64_t now_us) const {
  UnpackTraversal traversal(type_->fingerprint, packed, now_us);
  if (!traversal.Body(*plan_, true)) return std::nullopt;
  const auto used = traversal.Used();
  std::vector<std::byte> encoded = traversal.Finish();
  if (!used || !Walk(*type_, encoded)) return std::nullopt;
  packed = packed.subspan(*used);
  return encoded;
}

std::optional<std::vector<std::byte>> Packer::Unpack(std::span<const std::byte> packed,
                                                     std::int64_t now_us) const {
  auto encoded = UnpackFront(packed, now_us);
  if (!packed.empty()) return std::nullopt;
  return encoded;
}

std::string FormatBitTable(const Packer& packer) {
  std::size_t width = 5;
  for (const PackedField& field : packer.fields()) width = std::max(width, field.name.size());
  std::string text = fmt::format("{:<{}}  {:>5}  {:>6}  {:>6}  {:<8}  {:<7}  {}\n", "field", width, "bits",
                                 "values", "total", "unit", "outside", "codes");
  for (const PackedField& field : packer.fields()) {
    text += fmt::format("{:<{}}  {:>5}  {:>6}  {:>6}  {:<8}  {:<7}  {}\n", field.name, width, field.bits,
                        field.values, field.bits * field.values, field.unit,
                        field.refuse ? "refused" : "nearest", field.codes);
  }
  return text + fmt::format("{}: at most {} bits, {} bytes\n", packer.type().full_name, packer.MaxBits(),
                            packer.MaxBytes());
}

}  // namespace priamos::bus
