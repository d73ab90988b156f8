#pragma once

#include <optional>
#include <string>

#include "cli/terminal/braille.hpp"
#include "cli/terminal/text_table.hpp"
#include "common/time.hpp"
#include "priamos/landmark_fix_t.hpp"
#include "priamos/landmark_view_t.hpp"
#include "priamos/obstacle_line_t.hpp"

namespace priamos::cli {

/// What `priamos view` shows: what the head saw when it last looked for a landmark, and what the line laser
/// shows of the floor. Pure: time is given.
class ViewScreen {
 public:
  void Add(const landmark_view_t& view) { view_ = view; }
  void Add(const landmark_fix_t& fix) { fix_ = fix; }
  void Add(const obstacle_line_t& line) { line_ = line; }

  /// The screen as lines of text that fit `size`. Before the first message it shows what it waits for.
  std::string Render(Time now, ScreenSize size, bool colour) const;
  bool empty() const { return !view_ && !line_; }

 private:
  std::optional<landmark_view_t> view_;
  std::optional<landmark_fix_t> fix_;
  std::optional<obstacle_line_t> line_;
};

/// Title of a view in one line: the look, by its number on the bus, and its finding.
std::string ViewTitle(const landmark_view_t& view, const landmark_fix_t* fix);
/// Which landmark, found or why not, and how well if the fix of the same look is known.
std::string ViewFinding(const landmark_view_t& view, const landmark_fix_t* fix);
/// What the laser's line shows, in words and as a strip from 1 m left to 1 m right; lines of at most
/// `columns`.
std::string FloorText(const obstacle_line_t& line, double age_s, int columns);
/// Legend of a view in one line: camera and number of edges of each kind.
std::string ViewLegend(const landmark_view_t& view);
/// The edges of the picture.
Braille DrawView(const landmark_view_t& view, ScreenSize size);

}  // namespace priamos::cli
