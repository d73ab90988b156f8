#include "bus/schema/lcm_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "bus/schema/annotation.hpp"

namespace priamos::bus {
namespace {

/// `type` and all types in it by their names: without package first, since no text leads back from one.
std::map<std::pair<bool, std::string>, const Struct*> Closure(const Struct& type) {
  std::map<std::pair<bool, std::string>, const Struct*> found;
  std::vector<const Struct*> open{&type};
  while (!open.empty()) {
    const Struct* next = open.back();
    open.pop_back();
    if (!found.try_emplace({!next->package.empty(), next->full_name}, next).second) continue;
    for (const Field& field : next->fields)
      if (field.type != nullptr) open.push_back(field.type);
  }
  return found;
}

/// A comment that is one line in every reader's eyes.
std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, ' ');
  return text;
}

std::string CommentAbove(const std::string& text) {
  return text.empty() ? "" : fmt::format("  // {}\n", OneLine(text));
}

/// Where in a field's comment its annotation begins: what stands before it was a comment of its own.
std::size_t BeginOfAnnotation(const Field& field) {
  const Annotation& a = field.annotation;
  if (a.unit.empty() && a.problem.empty()) return 0;
  for (auto at = field.comment.find('['); at != std::string::npos; at = field.comment.find('[', at + 1)) {
    const Annotation read = ParseAnnotation(std::string_view(field.comment).substr(at));
    if (read.unit == a.unit && read.problem == a.problem) return at;
  }
  return 0;
}

std::string Text(const Field& field) {
  const std::size_t begin = BeginOfAnnotation(field);
  std::string text = CommentAbove(field.comment.substr(0, begin == 0 ? 0 : begin - 1));
  text += fmt::format("  {} {}", field.type_name, field.name);
  for (const Dimension& dimension : field.dims) text += "[" + dimension.text + "]";
  const std::string comment = OneLine(field.comment.substr(begin));
  return text + (comment.empty() ? ";\n" : fmt::format(";  // {}\n", comment));
}

std::string Text(const Struct& type) {
  std::string text = type.doc.empty() ? "" : fmt::format("// {}\n", OneLine(type.doc));
  text += fmt::format("struct {} {{\n", type.name);
  for (const Constant& constant : type.constants)
    text += fmt::format("  const {} {} = {};\n", KindName(constant.kind), constant.name, constant.text);
  for (const Field& field : type.fields) text += Text(field);
  return text + "}\n";
}

}  // namespace

std::string FormatLcm(const Struct& type) {
  std::string text, package;
  for (const auto& [name, next] : Closure(type)) {
    if (next->package != package) text += fmt::format("package {};\n", next->package);
    package = next->package;
    text += Text(*next);
  }
  return text;
}

}  // namespace priamos::bus
