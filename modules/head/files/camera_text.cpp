#include "head/files/camera_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "head/files/xml_text.hpp"
#include "head/files/yaml_text.hpp"

namespace priamos::head {
namespace {

using nlohmann::json;

void AddWords(const json& value, std::vector<std::string>& words) {
  if (value.is_array())
    for (const json& element : value) AddWords(element, words);
  else
    words.push_back(value.is_string() ? value.get<std::string>() : value.dump());
}

/// A list of objects counts as objects: "cameras/0/K".
void AddEntries(const json& value, const std::string& key, CameraEntries& entries) {
  const auto below = [&](const std::string& name) { return key.empty() ? name : key + "/" + name; };
  if (value.is_object()) {
    for (const auto& [name, member] : value.items()) AddEntries(member, below(name), entries);
  } else if (value.is_array() && !value.empty() && value.front().is_object()) {
    for (std::size_t i = 0; i < value.size(); ++i) AddEntries(value[i], below(std::to_string(i)), entries);
  } else {
    CameraEntry& entry = entries.emplace_back();
    entry.key = key;
    AddWords(value, entry.words);
  }
}

/// Objects in objects, and lists in lists, are followed this deep.
constexpr int kDeepest = 20;

Outcome<CameraEntries> ParseJson(std::string_view text) {
  const auto not_too_deep = [](int depth, json::parse_event_t, const json&) { return depth < kDeepest; };
  const json root = json::parse(text, not_too_deep, false);
  if (!root.is_object()) return Refusal{"expected JSON of a camera, got none, or a part of it"};
  CameraEntries entries;
  AddEntries(root, "", entries);
  return entries;
}

}  // namespace

Outcome<CameraEntries> ParseCameraText(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos) return Refusal{"expected a camera as YAML, XML or JSON, got an empty file"};
  if (text.find('\0') != text.npos) return Refusal{"expected a camera as YAML, XML or JSON, got no text"};
  if (text[begin] == '{') return ParseJson(text.substr(begin));
  return text[begin] == '<' ? ParseXml(text) : ParseYaml(text);
}

}  // namespace priamos::head
