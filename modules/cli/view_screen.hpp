#pragma once

#include <optional>
#include <string>

#include "cli/braille.hpp"
#include "common/time.hpp"
#include "priamos/landmark_fix_t.hpp"
#include "priamos/landmark_view_t.hpp"

namespace priamos::cli {

/// Size of a terminal in characters.
struct ScreenSize {
  int columns = 80, rows = 24;
};

/// What `priamos view` shows: what the head saw when it last looked for a landmark. Pure: time is given.
class ViewScreen {
 public:
  void Add(const landmark_view_t& view) { view_ = view; }
  void Add(const landmark_fix_t& fix) { fix_ = fix; }

  /// The screen as lines of text that fit `size`. Before the first view it says what it waits for.
  std::string Render(Time now, ScreenSize size, bool colour) const;
  bool empty() const { return !view_; }

 private:
  std::optional<landmark_view_t> view_;
  std::optional<landmark_fix_t> fix_;
};

/// In one line: which landmark, found or why not, and how well if the fix of the same look is known.
std::string ViewTitle(const landmark_view_t& view, const landmark_fix_t* fix);
/// In one line: camera and number of edges of each kind.
std::string ViewLegend(const landmark_view_t& view);
/// The edges of the picture.
Braille DrawView(const landmark_view_t& view, ScreenSize size);

}  // namespace priamos::cli
