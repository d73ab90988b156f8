#include "random_message.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos::bus {
namespace {

class Generator {
 public:
  Generator(const Struct& type, Values values, Rng& rng, std::int64_t now_us)
      : builder_(type), values_(values), rng_(rng), now_us_(now_us) {}

  Bytes Run(const Struct& type) {
    Body(type, 0);
    return builder_.bytes();
  }

 private:
  void Body(const Struct& type, int depth) {
    std::vector<std::int64_t> counts(type.fields.size(), -1);
    for (const Field& field : type.fields) {
      for (std::size_t i = 0; i < field.dims.size(); ++i) {
        if (!field.dims[i].variable) continue;
        const std::int64_t most = depth > 3 ? 0 : MaxCount(type, field, i).value_or(3);
        std::int64_t& count = counts[field.dims[i].count_field];
        if (count < 0 || count > most)
          count = static_cast<std::int64_t>(Below(static_cast<std::uint64_t>(most) + 1));
      }
    }
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const Field& field = type.fields[i];
      if (counts[i] >= 0) {
        PutInteger(field.kind, counts[i]);
        continue;
      }
      std::int64_t elements = 1;
      for (const Dimension& d : field.dims) elements *= d.variable ? counts[d.count_field] : d.size;
      for (std::int64_t k = 0; k < elements; ++k) Value(field, depth);
    }
  }

  void Value(const Field& field, int depth) {
    switch (field.kind) {
      case Kind::kStruct:
        return Body(*field.type, depth + 1);
      case Kind::kString:
        return Text(field);
      case Kind::kBoolean:
        builder_.Put(static_cast<std::int8_t>(Below(2)));
        return;
      case Kind::kByte:
        builder_.Put(static_cast<std::uint8_t>(Below(256)));
        return;
      case Kind::kFloat:
        builder_.Put(static_cast<float>(Real(field)));
        return;
      case Kind::kDouble:
        builder_.Put(Real(field));
        return;
      default:
        return PutInteger(field.kind, Integer(field));
    }
  }

  void Text(const Field& field) {
    std::string text(Below(static_cast<std::uint64_t>(MaxTextLength(field).value_or(8)) + 1), ' ');
    for (char& c : text) c = static_cast<char>(' ' + Below(95));
    builder_.Text(text);
  }

  double Real(const Field& field) {
    const Annotation& a = field.annotation;
    if (values_ == Values::kInRange && a.min) {
      if (a.invalid && Below(4) == 0) return a.invalid->value;
      switch (Below(8)) {
        case 0:
          return a.min->value;
        case 1:
          return a.max->value;
        default:
          return rng_.Uniform(a.min->value, a.max->value);
      }
    }
    constexpr double kSpecial[] = {0.0,
                                   -0.0,
                                   1e308,
                                   -1e-308,
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()};
    return Below(2) == 0 ? kSpecial[Below(std::size(kSpecial))] : rng_.Normal(1e3);
  }

  std::int64_t Integer(const Field& field) {
    const Annotation& a = field.annotation;
    if (values_ == Values::kInRange && a.age_us) {
      return now_us_ - static_cast<std::int64_t>(Below(static_cast<std::uint64_t>(*a.age_us) + 1));
    }
    if (values_ == Values::kInRange && a.min && a.min->integer) {
      if (a.invalid && Below(4) == 0) return *a.invalid->integer;
      const std::uint64_t span =
          static_cast<std::uint64_t>(*a.max->integer) - static_cast<std::uint64_t>(*a.min->integer);
      return static_cast<std::int64_t>(static_cast<std::uint64_t>(*a.min->integer) + Below(span + 1));
    }
    return static_cast<std::int64_t>(rng_.engine()());
  }

  void PutInteger(Kind kind, std::int64_t value) {
    std::byte word[8];
    WriteInteger(word, value, WireSize(kind));
    for (std::size_t i = 0; i < WireSize(kind); ++i) builder_.Put(std::to_integer<std::uint8_t>(word[i]));
  }

  std::uint64_t Below(std::uint64_t n) { return n == 0 ? rng_.engine()() : rng_.Below(n); }

  MessageBuilder builder_;
  Values values_;
  Rng& rng_;
  std::int64_t now_us_;
};

}  // namespace

Bytes RandomMessage(const Struct& type, Values values, Rng& rng, std::int64_t now_us) {
  return Generator(type, values, rng, now_us).Run(type);
}

}  // namespace priamos::bus
