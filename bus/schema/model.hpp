#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The content of a .lcm file, as data: filled by ParseLcm, completed (nested types, fingerprints) by Schema.
namespace priamos::bus {

/// A type that cannot be used. what() is one sentence, `file:line: ...`.
class SchemaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Type of a field's values: LCM's primitives, and kStruct for a struct of its own.
enum class Kind : std::uint8_t {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kFloat,
  kDouble,
  kBoolean,
  kByte,
  kString,
  kStruct
};

/// LCM's name of a primitive kind, "struct" for kStruct.
std::string_view KindName(Kind kind);
/// The primitive of that name; nullopt when it is no primitive of LCM.
std::optional<Kind> PrimitiveKind(std::string_view name);
/// Encoded bytes of one value; 0 for strings and structs, whose size is not fixed by the kind.
std::size_t WireSize(Kind kind);
/// True for the signed integers, int8_t to int64_t (a byte is not a number to LCM, it cannot be a count).
bool IsInteger(Kind kind);

/// A number of an annotation. `integer` is set when it was written without point or exponent and fits, so
/// that bounds of int64_t fields stay exact.
struct Number {
  double value = 0;
  std::optional<std::int64_t> integer;
};

/// The annotation in the comment of a field: `[unit] @frame F @range A,B @step S @invalid V @max N @age US
/// @refuse: meaning`.
struct Annotation {
  std::string unit;               ///< text in the brackets; "-" for plain numbers; empty when there is none
  std::string frame;              ///< `@frame`: the coordinate frame, empty when it has none
  std::optional<Number> min;      ///< `@range`, first number
  std::optional<Number> max;      ///< `@range`, second number
  std::optional<Number> step;     ///< `@step`: resolution on the radio, in `unit`
  std::optional<Number> invalid;  ///< `@invalid`: the value that means "none"
  /// Numbers of `@max`: largest counts of the variable dimensions, then largest text length.
  std::vector<std::int64_t> sizes;
  std::optional<std::int64_t> age_us;  ///< `@age`: a time stamp [us] that is at most this old when it is sent
  bool refuse = false;                 ///< `@refuse`: a message with a value out of range is not sent
  std::string meaning;                 ///< the sentence after the colon
  std::string problem;  ///< why the comment, though it begins with a bracket, cannot be read; else empty
};

/// One dimension of an array: a constant, or an integer field declared before in the same struct.
struct Dimension {
  std::string text;  ///< the size as written: LCM's fingerprint contains it
  bool variable = false;
  std::int64_t size = 0;        ///< elements of a constant dimension, > 0
  std::size_t count_field = 0;  ///< index into Struct::fields of a variable dimension's count
};

struct Struct;

/// One field of a struct with all its attributes from the .lcm file; `line` counts from 1.
struct Field {
  std::string name;
  Kind kind = Kind::kInt8;
  std::string type_name;         ///< primitive, or full name of the struct
  const Struct* type = nullptr;  ///< the nested struct if `kind` is kStruct: resolved by Schema, null before
  std::vector<Dimension> dims;
  std::string comment;  ///< leading and trailing comment as one line
  Annotation annotation;
  int line = 0;
};

/// One `const` of a struct; `line` counts from 1.
struct Constant {
  std::string name;
  Kind kind = Kind::kInt8;
  std::string text;  ///< the value as written
  Number value;
  int line = 0;
};

struct WalkPlan;

/// One message type as its .lcm file declares it; `line` counts from 1.
struct Struct {
  std::string package;    ///< "" when the file has none
  std::string name;       ///< without the package
  std::string full_name;  ///< "package.name"
  std::string doc;        ///< comment before the struct
  std::string file;
  int line = 0;
  std::vector<Constant> constants;
  std::vector<Field> fields;
  std::uint64_t fingerprint = 0;              ///< LCM's hash of the type, set by Schema
  std::shared_ptr<const WalkPlan> walk_plan;  ///< how Walk checks a message, set by Schema

  /// Begin of every error message about this struct: "file:line: type.field: ".
  std::string Where(const Field& field) const;
  /// Whether `field` is an enumeration: an integer whose meaning names a constant of this struct, "IDLE" or
  /// with "LIMIT_..." all that begin so.
  bool IsEnumeration(const Field& field) const;
};

}  // namespace priamos::bus
