#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::head {

/// Where the drawings of a run go: IMAGE-body.png in one folder, IMAGE-2-body.png for another image of that
/// name.
class BodyDrawings {
 public:
  /// No folder, no drawings. Throws std::runtime_error when it is not there.
  BodyDrawings(std::string folder, bool force);

  bool wanted() const { return !folder_.empty(); }
  /// Whether this run has drawn that file: as an image it is no longer what somebody took.
  bool HasDrawn(const std::string& file) const;
  /// Writes the drawing of `image`. Throws std::runtime_error when it would replace one of `inputs` or,
  /// unless forced, any file.
  void Write(const std::string& image, const std::vector<std::string>& inputs, std::string_view png);

 private:
  std::string folder_;
  bool force_;
  std::set<std::string> drawn_;
};

}  // namespace priamos::head
