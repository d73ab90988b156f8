#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <stdexcept>
#include <vector>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// Keeps the fields in the order of the .lcm file.
using Json = nlohmann::ordered_json;

/// A message that cannot be converted. what() is one sentence that begins with the field.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An encoded message as JSON: an object with every field. Nothing is lost:
/// - integers are JSON integers, also where JavaScript would round them;
/// - a float is the shortest decimal that reads back as it;
/// - NaN and the infinities are the strings "NaN", "Infinity", "-Infinity";
/// - booleans are true and false, any other byte in their place is a number;
/// - an array of bytes is a base64 string (as JSON schema's contentEncoding has it), other arrays are arrays;
/// - a string that is no UTF-8 is {"base64": "..."}.
/// Throws MessageError when Walk refuses the bytes.
Json ToJson(const Struct& type, std::span<const std::byte> encoded);

/// The inverse of ToJson. Counts of variable arrays may be left out; every other field has to be there, and
/// no other key. Throws MessageError, "edges[2].x_m: expected a number, got ...".
std::vector<std::byte> FromJson(const Struct& type, const Json& json);

}  // namespace priamos::bus
