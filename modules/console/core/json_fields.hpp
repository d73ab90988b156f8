#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace priamos::console {

// Fields of a client's JSON object. Each throws Wrong (read_json.hpp), a sentence that names the key, when
// the field is missing or no such value.

void RefuseOtherKeys(const nlohmann::json& object, std::initializer_list<std::string_view> known);
const nlohmann::json& Field(const nlohmann::json& object, const char* key);
/// False when it is missing.
bool Flag(const nlohmann::json& object, const char* key);
std::int64_t Whole(const nlohmann::json& object, const char* key, std::int64_t least, std::int64_t most);
/// A text of at most so many bytes.
std::string Word(const nlohmann::json& object, const char* key, std::size_t longest);
/// NaN is out of every range.
double Number(const nlohmann::json& object, const char* key, double least, double most);

}  // namespace priamos::console
