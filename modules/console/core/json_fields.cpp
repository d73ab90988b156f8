#include "console/core/json_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "console/core/read_json.hpp"

namespace priamos::console {

using nlohmann::json;

void RefuseOtherKeys(const json& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Wrong(fmt::format("key \"{}\" is not known", key.substr(0, 40)));
}

const json& Field(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) throw Wrong(fmt::format("key \"{}\" is missing", key));
  return *it;
}

bool Flag(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) return false;
  if (!it->is_boolean()) throw Wrong(fmt::format("{}: expected true or false", key));
  return it->get<bool>();
}

std::int64_t Whole(const json& object, const char* key, std::int64_t least, std::int64_t most) {
  const json& value = Field(object, key);
  const bool fits = value.is_number_integer() &&
                    !(value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(most)) &&
                    value.get<std::int64_t>() >= least && value.get<std::int64_t>() <= most;
  if (!fits) throw Wrong(fmt::format("{}: expected a whole number from {} to {}", key, least, most));
  return value.get<std::int64_t>();
}

std::string Word(const json& object, const char* key, std::size_t longest) {
  const json& value = Field(object, key);
  if (!value.is_string() || value.get_ref<const std::string&>().size() > longest)
    throw Wrong(fmt::format("{}: expected a text of at most {} bytes", key, longest));
  return value.get<std::string>();
}

double Number(const json& object, const char* key, double least, double most) {
  const json& value = Field(object, key);
  const double number = value.is_number() ? value.get<double>() : most + 1;
  if (!(number >= least && number <= most))
    throw Wrong(fmt::format("{}: expected a number from {} to {}", key, least, most));
  return number;
}

}  // namespace priamos::console
