#include "cli/terminal/field_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include "common/text/nearest_word.hpp"

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

/// Text of what may stand behind a field at one of its dimensions: `[0] to [23]`.
std::string Indices(const bus::Dimension& dimension) {
  return dimension.variable ? "a whole number in brackets like [0]"
                            : fmt::format("[0] to [{}]", dimension.size - 1);
}

[[noreturn]] void RefuseIndex(const std::string& path, const bus::Field& field, std::size_t depth,
                              std::string_view got) {
  const std::string expected =
      depth < field.dims.size()
          ? Indices(field.dims[depth])
          : (depth == 0 ? "none, it is no array" : fmt::format("no more than {} indices", depth));
  throw bus::MessageError(
      fmt::format("field {}: bad index behind {}: expected {}, got \"{}\"", path, field.name, expected, got));
}

/// Appends indices, `[3]` or `[3][0]`, behind the name of `field`, appended to `pointer`. Throws
/// MessageError.
void AppendIndices(std::string_view text, const std::string& path, const bus::Field& field,
                   bus::Json::json_pointer& pointer) {
  for (std::size_t depth = 0; !text.empty(); ++depth) {
    std::size_t index = 0;
    if (text.front() != '[' || depth == field.dims.size()) RefuseIndex(path, field, depth, text);
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), index);
    if (error != std::errc() || end == text.data() + text.size() || *end != ']')
      RefuseIndex(path, field, depth, text);
    const bus::Dimension& dimension = field.dims[depth];
    if (!dimension.variable && std::cmp_greater_equal(index, dimension.size))
      RefuseIndex(path, field, depth, text);
    pointer /= index;
    text.remove_prefix(static_cast<std::size_t>(end + 1 - text.data()));
  }
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
    AppendIndices(std::string_view(part).substr(bracket), text, field, pointer_);
    within = field.type;
  }
  if (text.empty() || text.back() == '.')
    throw bus::MessageError(fmt::format("field \"{}\": expected a name like x_m or ranges_m[3]", text));
}

bus::Json FieldPath::In(const bus::Json& message) const {
  return message.contains(pointer_) ? message.at(pointer_) : bus::Json();
}

}  // namespace priamos::cli
