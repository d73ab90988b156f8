#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/drawing/drawing.hpp"

namespace priamos::support {

/// The forms of one kind that a drawing has on the layer of this name, in the order of drawing; samples in
/// the legend, which lie below `bottom`, do not count.
template <class Form>
std::vector<Form> FormsOn(const drawing::Drawing& drawing, std::string_view layer, double bottom) {
  const auto is_legend = [bottom](const auto& form) {
    using T = std::decay_t<decltype(form)>;
    if constexpr (std::is_same_v<T, drawing::Path>) return form.points.front().y() > bottom;
    if constexpr (std::is_same_v<T, drawing::Circle>) return form.centre.y() > bottom;
    if constexpr (std::is_same_v<T, drawing::Text>) return form.at.y() > bottom;
  };
  std::vector<Form> forms;
  for (const drawing::Shape& shape : drawing.shapes())
    if (const auto* form = std::get_if<Form>(&shape.form); form && shape.layer && shape.layer->id == layer)
      if (!is_legend(*form)) forms.push_back(*form);
  return forms;
}

inline std::vector<drawing::Path> LinesOn(const drawing::Drawing& drawing, std::string_view layer,
                                          double bottom) {
  return FormsOn<drawing::Path>(drawing, layer, bottom);
}

/// What the legend says, in its order.
inline std::vector<std::string> MeaningsIn(const drawing::Drawing& drawing) {
  std::vector<std::string> meanings;
  for (const drawing::Layer* layer : drawing.LayersToExplain()) meanings.emplace_back(layer->meaning);
  return meanings;
}

}  // namespace priamos::support
