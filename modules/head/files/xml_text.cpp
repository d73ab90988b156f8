#include "head/files/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace priamos::head {
namespace {

constexpr std::size_t kDeepestElement = 16;
constexpr std::string_view kXmlBlanks = " \t\r\n";

/// What is wrong, with its line; caught where the text comes in.
struct XmlDamage {
  int line;
  std::string what;
};

class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : rest_(text) {}

  CameraEntries Read() {
    while (!rest_.empty()) {
      const std::size_t tag = std::min(rest_.find('<'), rest_.size());
      AddText(Take(tag));
      if (!rest_.empty()) AddTag();
    }
    if (!open_.empty())
      throw XmlDamage{line_, fmt::format("expected </{}>, got the end of the file", open_.back().name)};
    if (entries_.empty()) throw XmlDamage{line_, "expected elements, got none"};
    return std::move(entries_);
  }

 private:
  struct Element {
    std::string name, key;
    std::size_t entry;                ///< number of its entry
    std::map<std::string, int> seen;  ///< how often each name is in it
  };

  std::string_view Take(std::size_t n) {
    const std::string_view taken = rest_.substr(0, n);
    rest_.remove_prefix(taken.size());
    line_ += static_cast<int>(std::ranges::count(taken, '\n'));
    return taken;
  }
  std::string_view TakeUntil(std::string_view end, const char* what) {
    const std::size_t at = rest_.find(end);
    if (at == rest_.npos)
      throw XmlDamage{line_, fmt::format("expected the end of {} ({}), got the end of the file", what, end)};
    return Take(at + end.size());
  }

  void AddText(std::string_view text) {
    for (std::size_t at = text.find_first_not_of(kXmlBlanks); at != text.npos;) {
      const std::size_t end = std::min(text.find_first_of(kXmlBlanks, at), text.size());
      if (open_.empty()) throw XmlDamage{line_, "expected an element, got text outside of all"};
      entries_[open_.back().entry].words.emplace_back(text.substr(at, end - at));
      at = text.find_first_not_of(kXmlBlanks, end);
    }
  }

  void AddTag() {
    if (rest_.starts_with("<!--")) return void(TakeUntil("-->", "a comment"));
    if (rest_.starts_with("<?")) return void(TakeUntil("?>", "a declaration"));
    if (rest_.starts_with("<!"))
      throw XmlDamage{line_, "expected elements and text only, got a declaration <!"};
    const int line = line_;
    std::string_view tag = TakeUntil(">", "an element");
    tag = tag.substr(1, tag.size() - 2);
    if (tag.starts_with('/')) return Close(line, NameOf(tag.substr(1)));
    const bool is_empty = tag.ends_with('/');
    Open(line, NameOf(is_empty ? tag.substr(0, tag.size() - 1) : tag));
    if (is_empty) open_.pop_back();
  }
  static std::string NameOf(std::string_view tag) {
    return std::string(tag.substr(0, tag.find_first_of(kXmlBlanks)));
  }

  void Open(int line, const std::string& name) {
    if (name.empty()) throw XmlDamage{line, "expected the name of an element, got none"};
    if (open_.size() >= kDeepestElement) throw XmlDamage{line, "expected fewer elements within elements"};
    if (open_.empty() && !entries_.empty())
      throw XmlDamage{line, fmt::format("expected one root, got <{}> behind it", name)};
    Element element{name, "", entries_.size(), {}};
    if (!open_.empty()) {
      Element& parent = open_.back();
      const int number = ++parent.seen[name];
      element.key = parent.key.empty() ? name : parent.key + "/" + name;
      if (number > 1) element.key += fmt::format("#{}", number);
    }
    entries_.push_back({element.key, line, {}});
    open_.push_back(std::move(element));
  }
  void Close(int line, const std::string& name) {
    if (open_.empty() || open_.back().name != name)
      throw XmlDamage{line, fmt::format("expected {}, got </{}>",
                                        open_.empty() ? "an element" : "</" + open_.back().name + ">", name)};
    open_.pop_back();
  }

  std::string_view rest_;
  int line_ = 1;
  std::vector<Element> open_;
  CameraEntries entries_;
};

}  // namespace

Outcome<CameraEntries> ParseXml(std::string_view text) {
  try {
    return XmlReader(text).Read();
  } catch (const XmlDamage& damage) {
    return Refusal{fmt::format("{}: {}", damage.line, damage.what)};
  }
}

}  // namespace priamos::head
