#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace priamos::cli {

/// The release that a manual describes.
struct ManualIssue {
  std::string date;     ///< YYYY-MM-DD
  std::string release;  ///< "priamos 0.1.0"
};

/// One page of the manual in the language of man(7), put together piece by piece. All text is plain: what
/// troff would take for a command of its own is escaped.
class ManualPage {
 public:
  ManualPage(std::string name, int section, std::string_view summary, const ManualIssue& issue);

  void Section(std::string_view title);
  void Subsection(std::string_view title);
  /// A text; a blank line begins another paragraph.
  void Paragraph(std::string_view text);
  /// Lines as they are, in a fixed width.
  void Example(std::string_view lines);
  /// An entry of a list: `tag` bold, then `rest` on the same line, below it the text.
  void Term(std::string_view tag, std::string_view rest, std::string_view text);
  /// References, e.g. "priamos-topic(1)", separated by commas.
  void SeeAlso(const std::vector<std::string>& pages);

  const std::string& name() const { return name_; }
  std::string FileName() const;  ///< "priamos-topic.1"
  const std::string& Text() const { return text_; }

 private:
  void Begin();
  void Line(std::string_view text);

  std::string name_;
  int section_;
  std::string text_;
  bool begun_ = false;  ///< this section has a paragraph
};

}  // namespace priamos::cli
