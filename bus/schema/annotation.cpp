#include "bus/schema/annotation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/text/number_text.hpp"

namespace priamos::bus {
namespace {

constexpr std::string_view kBlank = " \t";

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Cuts the text before the first character out of `stops` off `text`.
std::string_view TakeUntil(std::string_view& text, std::string_view stops) {
  const std::size_t end = std::min(text.find_first_of(stops), text.size());
  const std::string_view head = text.substr(0, end);
  text.remove_prefix(end);
  return head;
}

std::vector<std::string_view> SplitAtCommas(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    parts.push_back(TakeUntil(text, ","));
    if (text.empty()) return parts;
    text.remove_prefix(1);
  }
}

/// One `@tag value`, as it is written.
struct Tag {
  std::string_view name;
  std::string_view value;
};

/// Fills an Annotation tag by tag; the first thing that cannot be read ends the reading.
class Reader {
 public:
  explicit Reader(Annotation& result) : result_(result) {}

  void Read(std::string_view text) {
    text.remove_prefix(1);
    result_.unit = Trim(TakeUntil(text, "]"));
    if (text.empty()) return Fail("the bracket of the unit is not closed");
    text.remove_prefix(1);
    if (result_.unit.empty()) return Fail("the unit is empty, [-] means a plain number");
    while (!(text = Trim(text)).empty() && result_.problem.empty()) {
      if (text.front() == ':') {
        result_.meaning = Trim(text.substr(1));
        return CheckAll();
      }
      if (text.front() != '@') return Fail("expected a @tag or a colon before the meaning");
      text.remove_prefix(1);
      Tag tag;
      tag.name = TakeUntil(text, " \t:");
      text = Trim(text);
      if (tag.name == "refuse") {  // the one tag without a value
        Refuse();
        continue;
      }
      tag.value = TakeUntil(text, " \t:");
      Apply(tag);
    }
    CheckAll();
  }

 private:
  void Apply(const Tag& tag) {
    if (tag.name == "frame") return Word(tag, result_.frame);
    if (tag.name == "step") return One(tag, result_.step);
    if (tag.name == "invalid") return One(tag, result_.invalid);
    if (tag.name == "range") return Range(tag);
    if (tag.name == "max") return Sizes(tag);
    if (tag.name == "age") return Age(tag);
    Fail(fmt::format("the tag @{} is not known", tag.name));
  }

  void Refuse() {
    if (result_.refuse) Fail("@refuse is there twice");
    result_.refuse = true;
  }

  void Word(const Tag& tag, std::string& word) {
    if (tag.value.empty() || !word.empty()) return Malformed(tag, "one word");
    word = tag.value;
  }

  void One(const Tag& tag, std::optional<Number>& number) {
    const bool again = number.has_value();
    number = ParseNumber(tag.value);
    if (!number || again) Malformed(tag, "one number");
  }

  void Range(const Tag& tag) {
    const auto parts = SplitAtCommas(tag.value);
    if (parts.size() != 2 || result_.min) return Malformed(tag, "two numbers A,B");
    result_.min = ParseNumber(parts[0]);
    result_.max = ParseNumber(parts[1]);
    if (!result_.min || !result_.max) Malformed(tag, "two numbers A,B");
  }

  void Sizes(const Tag& tag) {
    if (!result_.sizes.empty()) return Malformed(tag, "whole numbers, once");
    for (const std::string_view part : SplitAtCommas(tag.value)) {
      const auto number = ParseNumber(part);
      if (!number || !number->integer || *number->integer < 1 || *number->integer > 65535) {
        return Malformed(tag, "whole numbers from 1 to 65535");
      }
      result_.sizes.push_back(*number->integer);
    }
  }

  void Age(const Tag& tag) {
    const auto number = ParseNumber(tag.value);
    if (!number || !number->integer || *number->integer < 1 || result_.age_us) {
      return Malformed(tag, "microseconds, a whole number above 0");
    }
    result_.age_us = number->integer;
  }

  void CheckAll() {
    if (!result_.problem.empty()) return;
    if (result_.min && !(result_.min->value < result_.max->value)) {
      return Fail("the second number of @range is not above the first");
    }
    if (result_.step && !(result_.step->value > 0)) Fail("@step is not above 0");
    if (result_.age_us && result_.min) Fail("a time stamp has @age or @range, not both");
  }

  void Malformed(const Tag& tag, std::string_view expected) {
    Fail(fmt::format("@{} expects {}, got '{}'", tag.name, expected, tag.value));
  }
  void Fail(std::string_view sentence) {
    if (result_.problem.empty()) result_.problem = sentence;
  }

  Annotation& result_;
};

}  // namespace

std::optional<Number> ParseNumber(std::string_view text) {
  const auto value = NumberOf<double>(text);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  Number number;
  number.value = *value;
  number.integer = NumberOf<std::int64_t>(text);
  return number;
}

Annotation ParseAnnotation(std::string_view comment) {
  Annotation result;
  comment = Trim(comment);
  if (comment.starts_with('[')) {
    Reader(result).Read(comment);
  } else {
    result.meaning = comment;
  }
  return result;
}

}  // namespace priamos::bus
