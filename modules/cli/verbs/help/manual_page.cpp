#include "cli/verbs/help/manual_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace priamos::cli {
namespace {

/// A minus stays a minus that can be copied, a backslash is no escape.
std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

/// An argument of a macro: a quote inside is doubled.
std::string Argument(std::string_view text) {
  std::string quoted;
  for (const char c : Escaped(text)) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return '"' + quoted + '"';
}

std::string Upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

}  // namespace

ManualPage::ManualPage(std::string name, int section, std::string_view summary, const ManualIssue& issue)
    : name_(std::move(name)), section_(section) {
  text_ = fmt::format(".TH {} {} \"{}\" {} \"PRIAMOS\"\n.nh\n", Argument(Upper(name_)), section, issue.date,
                      Argument(issue.release));
  Section("NAME");
  if (summary.ends_with('.')) summary.remove_suffix(1);
  Line(fmt::format("{} - {}", name_, summary));
}

void ManualPage::Section(std::string_view title) {
  text_ += fmt::format(".SH {}\n", Argument(title));
  begun_ = false;
}

void ManualPage::Subsection(std::string_view title) {
  text_ += fmt::format(".SS {}\n", Argument(title));
  begun_ = false;
}

void ManualPage::Paragraph(std::string_view text) {
  bool begins = true;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(' ') == std::string::npos) {
      begins = true;
      continue;
    }
    if (begins) Begin();
    begins = false;
    Line(line);
  }
}

void ManualPage::Example(std::string_view lines) {
  Begin();
  text_ += ".nf\n.RS 4\n";
  std::istringstream in{std::string(lines)};
  for (std::string line; std::getline(in, line);) Line(line);
  text_ += ".RE\n.fi\n";
}

void ManualPage::Term(std::string_view tag, std::string_view rest, std::string_view text) {
  text_ += fmt::format(".TP\n\\fB{}\\fR{}\n", Escaped(tag), Escaped(rest));
  Line(text.empty() ? "There is no further description." : text);
  begun_ = true;
}

void ManualPage::SeeAlso(const std::vector<std::string>& pages) {
  Section("SEE ALSO");
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const auto bracket = pages[i].find('(');
    text_ += fmt::format(".BR {} {}{}\n", Escaped(pages[i].substr(0, bracket)), pages[i].substr(bracket),
                         i + 1 < pages.size() ? "," : "");
  }
}

std::string ManualPage::FileName() const {
  return fmt::format("{}.{}", name_, section_);
}

/// The first paragraph of a section needs no macro.
void ManualPage::Begin() {
  if (begun_) text_ += ".PP\n";
  begun_ = true;
}

/// A point or an apostrophe at the beginning would be a command.
void ManualPage::Line(std::string_view text) {
  if (text.starts_with('.') || text.starts_with('\'')) text_ += "\\&";
  text_ += Escaped(text) + "\n";
}

}  // namespace priamos::cli
