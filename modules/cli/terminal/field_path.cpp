#include "cli/terminal/field_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "common/nearest_word.hpp"

namespace priamos::cli {
namespace {

const bus::Field& Find(const bus::Struct& type, const std::string& name) {
  std::vector<std::string> known;
  for (const bus::Field& field : type.fields) {
    if (field.name == name) return field;
    known.push_back(field.name);
  }
  throw bus::MessageError(fmt::format("{}: unknown field \"{}\"{} (priamos type show {} lists all)",
                                      type.full_name, name, NearestText(name, known), type.name));
}

/// `[3]` or `[3][0]` behind the name of `field`, appended to `pointer`; false when it is something else.
bool AppendIndices(std::string_view text, const bus::Field& field, bus::Json::json_pointer& pointer) {
  std::size_t depth = 0;
  while (!text.empty()) {
    std::size_t index = 0;
    if (text.front() != '[' || ++depth > field.dims.size()) return false;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), index);
    if (error != std::errc() || end == text.data() + text.size() || *end != ']') return false;
    pointer /= index;
    text.remove_prefix(static_cast<std::size_t>(end + 1 - text.data()));
  }
  return true;
}

}  // namespace

FieldPath::FieldPath(const bus::Struct& type, const std::string& text) : text_(text) {
  const bus::Struct* within = &type;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, '.');) {
    const auto bracket = std::min(part.find('['), part.size());
    const std::string name = part.substr(0, bracket);
    if (within == nullptr)
      throw bus::MessageError(fmt::format("field {}: expected the end before \"{}\", got more", text, part));
    const bus::Field& field = Find(*within, name);
    pointer_ /= name;
    if (!AppendIndices(std::string_view(part).substr(bracket), field, pointer_))
      throw bus::MessageError(
          fmt::format("field {}: expected at most {} indices like [0] behind {}, got \"{}\"", text,
                      field.dims.size(), name, part.substr(bracket)));
    within = field.type;
  }
  if (text.empty() || text.back() == '.')
    throw bus::MessageError(fmt::format("field \"{}\": expected a name like x_m or ranges_m[3]", text));
}

bus::Json FieldPath::In(const bus::Json& message) const {
  return message.contains(pointer_) ? message.at(pointer_) : bus::Json();
}

}  // namespace priamos::cli
