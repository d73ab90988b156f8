#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bus/schema/json.hpp"

namespace priamos::cli {

/// A field of a message as a person names it: `x_m`, `ranges_m[3]`, `channels[0].bytes`.
class FieldPath {
 public:
  /// Path `text` to a field of messages of `type`. Throws MessageError that names the part which `type` does
  /// not have, and the nearest one it has.
  FieldPath(const bus::Struct& type, const std::string& text);

  const std::string& text() const { return text_; }
  /// Value of the field in a message of the type; null when an array of this message is too short.
  bus::Json In(const bus::Json& message) const;

 private:
  std::string text_;
  bus::Json::json_pointer pointer_;
};

}  // namespace priamos::cli
