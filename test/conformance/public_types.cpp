#include "public_types.hpp"

#include <iterator>
#include <regex>
#include <sstream>

namespace priamos {
namespace {

std::vector<std::string> LinesOf(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The line without comments, directives, and what stands in quotes.
std::string CodeOf(const std::string& line) {
  static const std::regex kNoCode(R"re(^\s*#.*|"(\\.|[^"\\])*"|\B'(\\.|[^'\\])'|//.*)re");
  return std::regex_replace(line, kNoCode, "");
}

/// Statement without a leading `template <...>`.
std::string WithoutTemplate(const std::string& statement) {
  if (!statement.starts_with("template")) return statement;
  int depth = 0;
  for (std::size_t i = 0; i < statement.size(); ++i) {
    if (statement[i] == '<') ++depth;
    if (statement[i] == '>' && --depth == 0) return statement.substr(statement.find_first_not_of(' ', i + 1));
  }
  return statement;
}

/// What stands between two braces.
struct Scope {
  bool has_members = false;  ///< a namespace or a type, no body of a function
  bool nameable = false;     ///< who includes the header can name it
  bool is_public = false;    ///< what is defined here now can be named when the scope can
  bool ShowsMembers() const { return has_members && nameable && is_public; }
};

class Reader {
 public:
  explicit Reader(std::string_view header) : lines_(LinesOf(header)) {}

  std::vector<PublicType> Read() {
    for (line_ = 1; line_ <= static_cast<int>(lines_.size()); ++line_) {
      for (const char c : CodeOf(lines_[line_ - 1])) Take(c);
      Take(' ');
    }
    return std::move(found_);
  }

 private:
  void Take(char c) {
    if (c == '{') scopes_.push_back(Opened(WithoutTemplate(statement_)));
    if (c == '}' && scopes_.size() > 1) scopes_.pop_back();
    if (c == '{' || c == '}' || c == ';' || (c == ':' && IsLabel())) return statement_.clear();
    if (c == ' ' && (statement_.empty() || statement_.back() == ' ')) return;
    if (statement_.empty()) began_ = line_;
    statement_ += c;
  }
  bool IsLabel() {
    const bool is_public = statement_ == "public";
    if (!is_public && statement_ != "protected" && statement_ != "private") return false;
    scopes_.back().is_public = is_public;
    return true;
  }
  Scope Opened(const std::string& statement) {
    static const std::regex kNamespace(R"((?:inline )?namespace ?([\w:]*) ?)");
    static const std::regex kType(
        R"((class|struct|union|enum(?: class| struct)?) ?(?:(?:alignas ?\([^()]*\)|\[\[[^\]]*\]\]|__attribute__ ?\(\(.*?\)\)) ?)*(\b\w+)(?: ?<.*>)?(?: final)?(?: ?:.*| ?))");
    const bool shown = scopes_.back().ShowsMembers();
    std::smatch m;
    if (std::regex_match(statement, m, kNamespace)) {
      const std::string name = m[1];
      static const std::regex kPrivate("(?:.*::)?(?:detail|internal)");
      return {true, shown && !name.empty() && !std::regex_match(name, kPrivate), true};
    }
    if (!std::regex_match(statement, m, kType)) return {};
    if (shown) found_.push_back({m[2], began_, DocumentedBefore(began_)});
    return {true, shown, m[1] != "class"};
  }
  /// Whether the lines before say something: two words at least.
  bool DocumentedBefore(int line) const {
    static const std::regex kWord(R"([A-Za-z][\w-]*)");
    std::ptrdiff_t words = 0;
    for (int i = line - 2; i >= 0; --i) {
      const std::string& before = lines_[i];
      const auto text = before.find_first_not_of(' ');
      if (text == std::string::npos || before.compare(text, 3, "///") != 0) break;
      words += std::distance(std::sregex_iterator(before.begin(), before.end(), kWord), {});
    }
    return words >= 2;
  }

  std::vector<std::string> lines_;
  int line_ = 0, began_ = 0;
  std::string statement_;
  std::vector<Scope> scopes_{{true, true, true}};
  std::vector<PublicType> found_;
};

}  // namespace

std::vector<PublicType> PublicTypesOf(std::string_view header) {
  return Reader(header).Read();
}

}  // namespace priamos
