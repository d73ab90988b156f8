#include "head/see/see_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "common/replace_file.hpp"

namespace priamos::head {
namespace {

namespace fs = std::filesystem;

/// The folder's name keeps left/50.jpg and right/50.jpg apart where their drawings lie in one folder.
std::string NameIn(const PlannedDrawing& drawing, bool with_folder) {
  const fs::path image(drawing.image);
  const std::string folder = fs::absolute(image).parent_path().filename();
  return fmt::format("{}{}-{}.png", with_folder ? folder + "-" : "", image.stem().string(), drawing.what);
}

bool HasNamesake(const PlannedDrawing& drawing, const std::vector<PlannedDrawing>& all) {
  return std::any_of(all.begin(), all.end(), [&](const PlannedDrawing& other) {
    return other.image != drawing.image && fs::path(other.image).stem() == fs::path(drawing.image).stem();
  });
}

fs::path PlaceOf(const PlannedDrawing& drawing, const std::vector<PlannedDrawing>& all,
                 const fs::path& output) {
  if (output.empty()) return fs::path(drawing.image).parent_path() / NameIn(drawing, false);
  std::error_code none;
  if (fs::is_directory(output, none)) return output / NameIn(drawing, HasNamesake(drawing, all));
  if (output.extension() != ".png")
    throw std::runtime_error(fmt::format(
        "--output {}: expected a folder that exists or a file .png, got neither", output.string()));
  if (all.size() > 1)
    throw std::runtime_error(fmt::format("--output {}: expected a folder for {} drawings, got a file",
                                         output.string(), all.size()));
  return output;
}

}  // namespace

SeeOutput::SeeOutput(const std::vector<PlannedDrawing>& drawings, const std::vector<std::string>& inputs,
                     const std::string& output, bool force) {
  for (const PlannedDrawing& drawing : drawings) {
    const fs::path file = PlaceOf(drawing, drawings, output);
    for (const Place& other : places_)
      if (other.file == file)
        throw std::runtime_error(
            fmt::format("{} and {}: expected images whose drawings have different names, "
                        "got {} twice; draw them one after the other with --output",
                        other.drawing.image, drawing.image, file.string()));
    RefuseToReplace(file, inputs, force);
    places_.push_back({drawing, file});
  }
}

std::string SeeOutput::FileOf(const std::string& image, std::string_view what) const {
  for (const Place& place : places_)
    if (place.drawing.image == image && place.drawing.what == what) return place.file;
  throw std::logic_error(fmt::format("{}-{}: a drawing that was not planned", image, what));
}

std::string SeeOutput::Add(const std::string& image, std::string_view what, std::string bytes) {
  std::string file = FileOf(image, what);
  finished_.emplace_back(file, std::move(bytes));
  return file;
}

void SeeOutput::Write() const {
  for (const auto& [file, bytes] : finished_) WriteWhole(file, bytes);
}

void RefuseToReplace(const fs::path& file, const std::vector<std::string>& inputs, bool force) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return;
  for (const std::string& input : inputs)
    if (fs::equivalent(file, input, none))
      throw std::runtime_error(
          fmt::format("{}: expected another file to write than one that is read", file.string()));
  if (!force)
    throw std::runtime_error(
        fmt::format("{}: is there already; name another place, or --force replaces it", file.string()));
}

void WriteWhole(const std::string& file, std::string_view bytes) {
  constexpr unsigned kMode = 0644;
  std::error_code none;
  const bool is_new = !fs::exists(file, none) || fs::is_regular_file(file, none);
  // A pipe or /dev/stdout is written to, not replaced.
  if (is_new ? ReplaceFile(file, bytes, false, kMode) : bool(std::ofstream(file) << bytes << std::flush))
    return;
  throw std::runtime_error(
      fmt::format("{}: cannot be written: {}; name another place", file, std::strerror(errno)));
}

}  // namespace priamos::head
