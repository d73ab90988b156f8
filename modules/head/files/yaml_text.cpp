#include "head/files/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace priamos::head {
namespace {

constexpr int kDeepestMap = 8;
constexpr std::string_view kYamlBlanks = " \t\r";

/// What is wrong, with its line; caught where the text comes in.
struct YamlDamage {
  int line;
  std::string what;
};

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kYamlBlanks);
  return begin == text.npos ? std::string_view()
                            : text.substr(begin, text.find_last_not_of(kYamlBlanks) - begin + 1);
}

std::string_view WithoutQuotes(std::string_view word) {
  const bool quoted = word.size() > 1 && (word[0] == '"' || word[0] == '\'') && word.back() == word[0];
  return quoted ? word.substr(1, word.size() - 2) : word;
}

/// A line without its comment: # at the beginning or behind a blank, not between quotes.
std::string_view WithoutComment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0 ? line[i] == quote : line[i] == '"' || line[i] == '\'')
      quote = quote != 0 ? 0 : line[i];
    else if (quote == 0 && line[i] == '#' && (i == 0 || kYamlBlanks.find(line[i - 1]) != kYamlBlanks.npos))
      return line.substr(0, i);
  }
  return line;
}

/// Where the key of "key: value" ends; npos if it is none. In a flow map the blank may be missing, as OpenCV
/// writes it.
std::size_t EndOfKey(std::string_view text, bool in_flow) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == ':' &&
        (in_flow || i + 1 == text.size() || kYamlBlanks.find(text[i + 1]) != kYamlBlanks.npos))
      return i;
  return text.npos;
}

/// Brackets that the text opens and does not close; negative if it closes more than it opens.
int OpenBrackets(std::string_view text) {
  int open = 0;
  for (const char c : text) open += (c == '[' || c == '{') - (c == ']' || c == '}');
  return open;
}

class YamlReader {
 public:
  explicit YamlReader(std::string_view text) : rest_(text) {}

  CameraEntries Read() {
    for (std::string_view line; NextLine(line);) {
      const std::string_view content = Trim(line);
      if (content.empty() || content[0] == '%') continue;
      if (content == "---" || content.starts_with("--- ") || content == "...") {
        if (!entries_.empty()) break;  // the next document
        continue;
      }
      if (line.find('\t') < line.find_first_not_of(kYamlBlanks))
        throw YamlDamage{line_, "expected blanks before a key, got a tabulator"};
      AddLine(static_cast<int>(line.find_first_not_of(' ')), content);
    }
    return std::move(entries_);
  }

 private:
  struct Level {
    int indent;
    std::string key;
  };

  bool NextLine(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = WithoutComment(rest_.substr(0, end));
    rest_ = end == rest_.npos ? std::string_view() : rest_.substr(end + 1);
    ++line_;
    return true;
  }

  void AddLine(int indent, std::string_view content) {
    if (content == "-" || content.starts_with("- ")) return AddItem(content.substr(1));
    const std::size_t end = EndOfKey(content, false);
    if (end == content.npos || end == 0)
      throw YamlDamage{line_, fmt::format("expected \"key: value\", got \"{}\"", content.substr(0, 40))};
    while (!levels_.empty() && levels_.back().indent >= indent) levels_.pop_back();
    if (levels_.size() >= kDeepestMap) throw YamlDamage{line_, "expected fewer keys within keys"};
    const std::string parent = levels_.empty() ? "" : levels_.back().key + "/";
    levels_.push_back({indent, parent + std::string(WithoutQuotes(Trim(content.substr(0, end))))});
    AddValue(levels_.back().key, line_, Trim(content.substr(end + 1)), 0);
  }

  /// An element of a list that has a line for each.
  void AddItem(std::string_view item) {
    if (entries_.empty()) throw YamlDamage{line_, "expected \"key: value\", got an element of a list"};
    item = Trim(item);
    if (item.starts_with('[') || item.starts_with('{'))
      SplitList(UntilClosed(entries_.back().key, line_, item), entries_.back().words);
    else
      entries_.back().words.emplace_back(WithoutQuotes(item));
  }

  void AddValue(const std::string& key, int line, std::string_view value, int depth) {
    if (value.starts_with('!')) value = Trim(value.substr(std::min(value.find(' '), value.size())));
    const std::string whole =
        value.starts_with('[') || value.starts_with('{') ? UntilClosed(key, line, value) : std::string(value);
    if (whole.starts_with('{')) return AddFlowMap(key, line, whole, depth);
    if (const auto [same, is_new] = line_of_.emplace(key, line); !is_new)
      throw YamlDamage{line,
                       fmt::format("{}: expected it once, got it in line {} already", key, same->second)};
    CameraEntry& entry = entries_.emplace_back(CameraEntry{key, line, {}});
    if (whole.starts_with('['))
      SplitList(whole, entry.words);
    else if (!whole.empty())
      entry.words.emplace_back(WithoutQuotes(whole));
  }

  /// A value in brackets, which may go on in the next lines.
  std::string UntilClosed(const std::string& key, int line, std::string_view value) {
    std::string whole(value);
    std::string_view next;
    int open = OpenBrackets(whole);
    while (open > 0) {
      if (!NextLine(next))
        throw YamlDamage{line, fmt::format("{}: expected a list or map with its end, got a part of it", key)};
      open += OpenBrackets(Trim(next));
      (whole += ' ') += Trim(next);
    }
    if (open < 0 || (whole.back() != ']' && whole.back() != '}'))
      throw YamlDamage{line, fmt::format("{}: expected brackets in pairs, got others", key)};
    return whole;
  }

  static void SplitList(std::string_view list, std::vector<std::string>& words) {
    constexpr std::string_view kBetween = "[], \t\r";
    for (std::size_t at = list.find_first_not_of(kBetween); at != list.npos;) {
      const std::size_t end = std::min(list.find_first_of(kBetween, at), list.size());
      words.emplace_back(WithoutQuotes(list.substr(at, end - at)));
      at = list.find_first_not_of(kBetween, end);
    }
  }

  /// {a: 1, b: [2, 3]}
  void AddFlowMap(const std::string& key, int line, std::string_view map, int depth) {
    if (depth >= kDeepestMap) throw YamlDamage{line, fmt::format("{}: expected fewer maps within maps", key)};
    map = map.substr(1, map.size() - 2);
    int open = 0;
    for (std::size_t begin = 0, i = 0; i <= map.size(); ++i) {
      const char c = i < map.size() ? map[i] : ',';
      open += (c == '[' || c == '{') - (c == ']' || c == '}');
      if (c != ',' || (open > 0 && i < map.size())) continue;
      const std::string_view part = Trim(map.substr(begin, i - begin));
      begin = i + 1;
      if (part.empty()) continue;
      const std::size_t end = EndOfKey(part, true);
      if (end == part.npos)
        throw YamlDamage{line, fmt::format("{}: expected \"key: value\" in its map", key)};
      AddValue(fmt::format("{}/{}", key, WithoutQuotes(Trim(part.substr(0, end)))), line,
               Trim(part.substr(end + 1)), depth + 1);
    }
  }

  std::string_view rest_;
  int line_ = 0;
  std::vector<Level> levels_;  ///< the keys that the present line lies in
  CameraEntries entries_;
  std::map<std::string, int> line_of_;  ///< of each key of an entry
};

}  // namespace

Outcome<CameraEntries> ParseYaml(std::string_view text) {
  try {
    return YamlReader(text).Read();
  } catch (const YamlDamage& damage) {
    return Refusal{fmt::format("{}: {}", damage.line, damage.what)};
  }
}

}  // namespace priamos::head
