#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace priamos {

/// What an SVG picture of ours says, whatever typeface it was measured with.
struct SvgContent {
  std::vector<std::string> texts;             ///< in the order of drawing
  std::map<std::string, std::size_t> layers;  ///< number of shapes of each
  std::map<std::string, std::string> paths;   ///< points of the first line of each layer

  std::string TextThatBegins(const std::string& with) const {
    for (const auto& text : texts)
      if (text.starts_with(with)) return text;
    return "";
  }
};

/// By lines, as ToSvg writes them: std::regex cannot hold a path of thousands of points.
inline SvgContent ContentOf(const std::string& svg) {
  SvgContent content;
  std::istringstream lines(svg);
  std::string layer;
  const auto between = [](const std::string& line, const std::string& from, const std::string& to) {
    const auto begin = line.find(from);
    if (begin == std::string::npos) return std::string();
    const auto at = begin + from.size();
    return line.substr(at, line.find(to, at) - at);
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("<g class=")) layer = between(line, "class=\"", "\"");
    if (line == "</g>") layer.clear();
    if (layer.empty() || line.starts_with("<g ")) continue;
    ++content.layers[layer];
    if (line.starts_with("<text ")) content.texts.push_back(between(line, ">", "<"));
    if (line.starts_with("<polyline")) content.paths.try_emplace(layer, between(line, "points=\"", "\""));
  }
  return content;
}

}  // namespace priamos
