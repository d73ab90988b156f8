#include "bus/schema/pack_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bus/schema/bit_stream.hpp"
#include "bus/schema/fingerprint.hpp"
#include "bus/schema/schema.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kMaxEncoded = 65535;
constexpr std::size_t kMaxFields = 10000;
constexpr std::int64_t kMaxValues = 65535;

struct Limits {
  std::int64_t low;
  std::int64_t high;
};

Limits LimitsOf(Kind kind) {
  if (kind == Kind::kByte) return {0, 255};
  const int bits = static_cast<int>(8 * WireSize(kind));
  const std::int64_t high = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
  return {-high - 1, high};
}

class PackPlanner {
 public:
  PackPlanner(const Struct& type, std::string prefix, std::int64_t repeats, std::vector<PackedField>& rows,
              std::size_t& fields)
      : type_(type), prefix_(std::move(prefix)), repeats_(repeats), rows_(rows), fields_(fields) {}

  std::shared_ptr<const PackPlan> Run() {
    count_numbers_.assign(type_.fields.size(), -1);
    for (const Field& field : type_.fields) Plan(field);
    return std::make_shared<const PackPlan>(std::move(plan_));
  }

 private:
  void Plan(const Field& field) {
    if (!field.annotation.problem.empty()) Fail(field, field.annotation.problem);
    CheckSizes(field);
    if (++fields_ > kMaxFields) Fail(field, "the type has too many fields to pack");
    PackStep step;
    step.kind = field.kind;
    step.row = rows_.size();
    std::int64_t values = repeats_;
    std::string name = prefix_ + field.name;
    for (std::size_t i = 0; i < field.dims.size(); ++i) {
      values *= *MaxCount(type_, field, i);
      if (values > kMaxValues) Fail(field, fmt::format("more than {} values cannot be packed", kMaxValues));
      const Dimension& d = field.dims[i];
      step.dims.push_back(d.variable ? -1 - count_numbers_[d.count_field] : d.size);
      name += "[]";
    }
    if (field.kind == Kind::kStruct) {
      if (field.annotation.refuse) Fail(field, "@refuse belongs to the fields of the struct");
      step.code = StructPack{PackPlanner(*field.type, name + ".", values, rows_, fields_).Run()};
    } else {
      rows_.push_back({.name = name, .unit = field.annotation.unit, .values = values, .codes = ""});
      Code(field, step);
      if (rows_.back().bits == 0) rows_.back().bits = step.bits;
      step.refuse = Refuses(field, step);
      rows_.back().refuse = step.refuse;
    }
    plan_.steps.push_back(std::move(step));
  }

  void CheckSizes(const Field& field) const {
    const auto variable = static_cast<std::size_t>(
        std::count_if(field.dims.begin(), field.dims.end(), [](const Dimension& d) { return d.variable; }));
    const std::size_t given = field.annotation.sizes.size();
    const bool text = field.kind == Kind::kString;
    if (given != 0 && given != variable + (text ? 1 : 0) && !(text && given == 1)) {
      Fail(field, fmt::format("@max has {} numbers for {} variable dimensions", given, variable));
    }
    for (std::size_t i = 0; i < field.dims.size(); ++i) {
      if (!MaxCount(type_, field, i)) {
        Fail(field, fmt::format("packing needs @max here or @range at {}", field.dims[i].text));
      }
    }
  }

  /// Whether a value outside its range keeps the message from being sent. The nearest value of an enumeration
  /// means something else; a count is none, whatever its comment names.
  bool Refuses(const Field& field, const PackStep& step) const {
    if (field.annotation.refuse && field.kind == Kind::kBoolean)
      Fail(field, "@refuse is for fields with a range, and a boolean has none");
    const bool counts = std::holds_alternative<CountPack>(step.code);
    return field.annotation.refuse || (!counts && type_.IsEnumeration(field));
  }

  void Code(const Field& field, PackStep& step) {
    if (const auto most = CountBound(field)) return CodeCount(field, *most, step);
    switch (field.kind) {
      case Kind::kBoolean:
        step.code = BooleanPack{};
        step.bits = 1;
        rows_.back().codes = "false, true";
        return;
      case Kind::kString:
        return CodeText(field, step);
      case Kind::kFloat:
      case Kind::kDouble:
        return CodeReal(field, step);
      default:
        return field.annotation.age_us ? CodeAge(field, step) : CodeInteger(field, step);
    }
  }

  /// The most elements of the arrays that `field` counts; nullopt when it counts none.
  std::optional<std::int64_t> CountBound(const Field& field) const {
    std::optional<std::int64_t> bound;
    for (const Field& array : type_.fields) {
      for (std::size_t i = 0; i < array.dims.size(); ++i) {
        const Dimension& d = array.dims[i];
        if (!d.variable || &type_.fields[d.count_field] != &field) continue;
        const auto most = MaxCount(type_, array, i);
        if (most) bound = bound ? std::min(*bound, *most) : *most;
        if (!bound) bound = LimitsOf(field.kind).high;  // CheckSizes of the array will refuse it
      }
    }
    return bound;
  }

  void CodeCount(const Field& field, std::int64_t most, PackStep& step) {
    const Annotation& a = field.annotation;
    if (most > LimitsOf(field.kind).high)
      Fail(field, fmt::format("a {} cannot count to {}", KindName(field.kind), most));
    if (a.invalid || (a.step && a.step->integer != 1))
      Fail(field, "a count has neither @invalid nor a @step but 1");
    const IntegerCode code(0, std::max<std::int64_t>(most, 1), 1, std::nullopt);
    count_numbers_[static_cast<std::size_t>(&field - type_.fields.data())] =
        static_cast<std::int64_t>(plan_.counts);
    step.code = CountPack{code, plan_.counts++};
    step.bits = BitsFor(code.last());
    rows_.back().codes = fmt::format("count 0..{}", most);
  }

  void CodeText(const Field& field, PackStep& step) {
    const auto length = MaxTextLength(field);
    if (!length) Fail(field, "packing needs @max, the largest length of the text");
    const TextPack text{*length, BitsFor(static_cast<std::uint64_t>(*length)),
                        field.annotation.unit == "ascii" ? 7 : 8};
    step.code = text;
    step.bits = text.length_bits;
    rows_.back().bits = text.length_bits + static_cast<int>(*length) * text.char_bits;
    rows_.back().codes = fmt::format("length 0..{}, {} bits each", *length, text.char_bits);
  }

  void CodeReal(const Field& field, PackStep& step) {
    const Annotation& a = field.annotation;
    if (!a.min) Fail(field, "packing needs @range");
    if (!a.step) Fail(field, "packing needs @step");
    const auto largest =
        static_cast<double>(field.kind == Kind::kFloat ? std::numeric_limits<float>::max()
                                                       : std::numeric_limits<double>::max() / 4);
    if (std::max(-a.min->value, a.max->value) > largest)
      Fail(field, "@range is beyond what the type can hold");
    if (!(RealCode::Steps(a.min->value, a.max->value, a.step->value) <= 0x1p52)) {
      Fail(field, "@range has more than 2^52 steps");
    }
    std::optional<double> invalid;
    if (a.invalid) {
      invalid = field.kind == Kind::kFloat ? static_cast<double>(static_cast<float>(a.invalid->value))
                                           : a.invalid->value;
    }
    const RealCode code(a.min->value, a.max->value, a.step->value, invalid);
    step.bits = BitsFor(code.last());
    step.code = code;
    rows_.back().codes = RangeText(a, a.step->value);
  }

  void CodeInteger(const Field& field, PackStep& step) {
    const Annotation& a = field.annotation;
    const Limits limits = LimitsOf(field.kind);
    if (!a.min && field.kind != Kind::kByte) Fail(field, "packing needs @range");
    const Number min = a.min.value_or(Number{0, 0});
    const Number max = a.max.value_or(Number{255, 255});
    const Number by = a.step.value_or(Number{1, 1});
    if (!min.integer || !max.integer || !by.integer)
      Fail(field, "@range and @step of an integer are whole numbers");
    if (*min.integer < limits.low || *max.integer > limits.high) {
      Fail(field, fmt::format("@range is beyond what {} can hold", KindName(field.kind)));
    }
    std::optional<std::int64_t> invalid;
    if (a.invalid) {
      invalid = a.invalid->integer;
      if (!invalid || *invalid < limits.low || *invalid > limits.high) {
        Fail(field, fmt::format("@invalid is no value of {}", KindName(field.kind)));
      }
    }
    const auto by_step = static_cast<std::uint64_t>(*by.integer);
    if (!IntegerCode::Fits(*min.integer, *max.integer, by_step, invalid.has_value())) {
      Fail(field, "@range leaves no code for @invalid");
    }
    const IntegerCode code(*min.integer, *max.integer, by_step, invalid);
    step.bits = BitsFor(code.last());
    step.code = code;
    rows_.back().codes = RangeText(a, by.value);
    if (!a.min) rows_.back().codes = "0..255";
  }

  void CodeAge(const Field& field, PackStep& step) {
    const Annotation& a = field.annotation;
    if (field.kind != Kind::kInt64) Fail(field, "a time stamp with @age is an int64_t");
    if (!a.step || !a.step->integer) Fail(field, "packing needs @step, whole microseconds");
    if (a.invalid) Fail(field, "a time stamp with @age has no @invalid");
    const IntegerCode code(0, *a.age_us, static_cast<std::uint64_t>(*a.step->integer), std::nullopt);
    step.bits = BitsFor(code.last());
    step.code = AgePack{code};
    rows_.back().codes = fmt::format("age 0..{} by {}", *a.age_us, *a.step->integer);
  }

  static std::string RangeText(const Annotation& a, double step) {
    if (!a.min) return "";
    const auto text = [](const Number& n) {
      return n.integer ? fmt::format("{}", *n.integer) : fmt::format("{}", n.value);
    };
    const std::string range = fmt::format("{}..{} by {}", text(*a.min), text(*a.max), step);
    return a.invalid ? fmt::format("{}, or {}", range, text(*a.invalid)) : range;
  }

  [[noreturn]] void Fail(const Field& field, std::string_view sentence) const {
    throw SchemaError(type_.Where(field) + std::string(sentence));
  }

  const Struct& type_;
  std::string prefix_;
  std::int64_t repeats_;
  std::vector<PackedField>& rows_;
  std::size_t& fields_;                      // of the whole type, those of structs without rows too
  std::vector<std::int64_t> count_numbers_;  // per field: -1 when it counts nothing
  PackPlan plan_;
};

}  // namespace

std::shared_ptr<const PackPlan> MakePackPlan(const Struct& type, std::vector<PackedField>& rows) {
  const auto refuse = [&](std::string_view sentence) {
    throw SchemaError(fmt::format("{}:{}: {} {}", type.file, type.line, type.full_name, sentence));
  };
  if (ReachesRecursion(type)) refuse("has a type in it that contains itself, which cannot be packed");
  std::size_t fields = 0;
  auto plan = PackPlanner(type, "", 1, rows, fields).Run();
  const auto size = MaxEncodedSize(type);
  if (!size || *size > kMaxEncoded)
    refuse(fmt::format("may have more than {} bytes, which cannot be packed", kMaxEncoded));
  return plan;
}

}  // namespace priamos::bus
