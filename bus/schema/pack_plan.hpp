#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "bus/schema/model.hpp"
#include "bus/schema/pack_code.hpp"

namespace priamos::bus {

/// One row of the bit table: a field, or a field of a nested struct ("edges[].x1_m").
struct PackedField {
  std::string name;
  std::string unit;
  int bits = 0;             ///< size of one value; the largest size of a text
  std::int64_t values = 1;  ///< in a message, at most
  std::string codes;        ///< "-100..100 by 0.01", "age 0..5 s by 10 ms", "7 bit x 24" ...
  bool refuse = false;      ///< a message with a value outside them is not sent
};

struct PackPlan;

/// A boolean as one bit.
struct BooleanPack {};
/// A time stamp as its age, [us].
struct AgePack {
  IntegerCode code;
};
/// A text as its length and its characters; `max_length` in bytes, what is longer is cut.
struct TextPack {
  std::int64_t max_length = 0;
  int length_bits = 0;
  int char_bits = 8;  ///< 7 for [ascii]
};
/// A nested struct, field after field.
struct StructPack {
  std::shared_ptr<const PackPlan> plan;
};
/// The count of later arrays; arrays with more elements are cut.
struct CountPack {
  IntegerCode code;
  std::size_t number = 0;  ///< among the counts of its struct
};

/// One field: how many values, and how each is coded.
struct PackStep {
  Kind kind = Kind::kInt8;
  std::vector<std::int64_t> dims;  ///< >= 0: constant; < 0: count number -1 - dim
  std::variant<BooleanPack, RealCode, IntegerCode, AgePack, TextPack, StructPack, CountPack> code;
  int bits = 0;         ///< size of one value's code; of a text's length
  bool refuse = false;  ///< no nearest value: the message is refused
  std::size_t row = 0;  ///< index into the bit table
};

/// All fields of a struct in the order in which they are packed; `counts` of them are array lengths.
struct PackPlan {
  std::vector<PackStep> steps;
  std::size_t counts = 0;
};

/// Plans the packing of `type` and appends its rows to the bit table. Throws SchemaError with file and line
/// for a field whose annotation lacks what packing needs, for a type that contains itself and for one whose
/// messages may have more than 65535 bytes.
std::shared_ptr<const PackPlan> MakePackPlan(const Struct& type, std::vector<PackedField>& rows);

}  // namespace priamos::bus
