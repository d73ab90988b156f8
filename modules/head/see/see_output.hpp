#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace priamos::head {

/// One drawing that will be made: of which image, and what of it ("edges").
struct PlannedDrawing {
  std::string image;
  std::string what;
};

/// Where drawings go: IMAGE-WHAT.png beside their image, into the folder `output`, or, if there is one
/// drawing only, into the file `output` (.png). Throws std::runtime_error naming the file when `output` is
/// none of these, when two drawings would have the same name, when a drawing would replace one of `inputs`,
/// or, unless `force`, any file that is there already; nothing has been written then.
class SeeOutput {
 public:
  SeeOutput(const std::vector<PlannedDrawing>& drawings, const std::vector<std::string>& inputs,
            const std::string& output, bool force);

  /// The file of a planned drawing.
  std::string FileOf(const std::string& image, std::string_view what) const;
  /// Keeps the finished drawing; returns its file.
  std::string Add(const std::string& image, std::string_view what, std::string bytes);
  /// Writes all that was added. Throws std::runtime_error as WriteWhole does.
  void Write() const;

 private:
  struct Place {
    PlannedDrawing drawing;
    std::filesystem::path file;
  };
  std::vector<Place> places_;
  std::vector<std::pair<std::string, std::string>> finished_;  ///< file and bytes
};

/// Checks that `file` may be written. Throws std::runtime_error when it is one of `inputs`, or, unless
/// `force`, there.
void RefuseToReplace(const std::filesystem::path& file, const std::vector<std::string>& inputs, bool force);

/// Writes a file as a whole. Throws std::runtime_error naming it and the reason when that fails.
void WriteWhole(const std::string& file, std::string_view bytes);

}  // namespace priamos::head
