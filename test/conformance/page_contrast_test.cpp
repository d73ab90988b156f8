// Whoever sees little must be able to read the page: contrasts of WCAG 2.1, level AA, in both colour schemes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>

#include "source_tree.hpp"

namespace priamos {
namespace {

using Palette = std::map<std::string, std::string>;

/// The colours of a `:root { ... }` block: name without dashes to rrggbb.
Palette PaletteIn(const std::string& block) {
  Palette palette;
  const std::regex colour("--([a-z0-9-]+): #([0-9a-f]{6});");
  for (std::sregex_iterator it(block.begin(), block.end(), colour), end; it != end; ++it)
    palette[(*it)[1]] = (*it)[2];
  return palette;
}

/// Relative luminance of WCAG 2.1.
double Luminance(const std::string& rgb) {
  double sum = 0;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(rgb.substr(2 * i, 2), nullptr, 16) / 255.0;
    sum += weights[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double Contrast(const std::string& a, const std::string& b) {
  const double la = Luminance(a), lb = Luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

class PageColours : public testing::TestWithParam<bool> {
 protected:
  PageColours() {
    const std::string style = TextOf(PRIAMOS_SOURCE_DIR "/modules/console/page/style.css");
    const auto dark = style.find("@media (prefers-color-scheme: dark)");
    palette_ = PaletteIn(style.substr(0, dark));
    if (!GetParam()) return;
    for (const auto& [name, rgb] : PaletteIn(style.substr(dark, style.find("* {") - dark)))
      palette_[name] = rgb;
  }
  void Expect(const std::string& front, const std::string& back, double least) {
    ASSERT_TRUE(palette_.contains(front) && palette_.contains(back)) << front << " on " << back;
    EXPECT_GE(Contrast(palette_[front], palette_[back]), least) << front << " on " << back;
  }
  Palette palette_;
};

TEST_P(PageColours, TextsCanBeRead) {
  for (const char* front : {"text", "soft", "accent", "warn", "bad", "good", "stale"})
    Expect(front, "card", 4.5);
  for (const char* front : {"text", "soft"}) Expect(front, "back", 4.5);
  Expect("accent-text", "accent", 4.5);
  Expect("stop-text", "stop", 4.5);
}

TEST_P(PageColours, LinesOfPlanAndChartsCanBeSeen) {
  for (const char* front :
       {"wall", "robot", "path", "sonar", "landmark", "learned", "accent", "bad", "stale"}) {
    Expect(front, "floor", 3);
    Expect(front, "seen", 3);
  }
  for (const char* front : {"line-1", "line-2", "line-3", "line-4", "line-5", "line-6"})
    Expect(front, "floor", 3);
}

INSTANTIATE_TEST_SUITE_P(LightAndDark, PageColours, testing::Bool());

}  // namespace
}  // namespace priamos
