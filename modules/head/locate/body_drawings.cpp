#include "head/locate/body_drawings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "head/see/see_output.hpp"

namespace priamos::head {

namespace fs = std::filesystem;

BodyDrawings::BodyDrawings(std::string folder, bool force) : folder_(std::move(folder)), force_(force) {
  std::error_code none;
  if (!folder_.empty() && !fs::is_directory(folder_, none))
    throw std::runtime_error(fmt::format("--draw {}: expected a folder that exists, got none", folder_));
}

bool BodyDrawings::HasDrawn(const std::string& file) const {
  std::error_code none;
  return std::ranges::any_of(drawn_, [&](const std::string& d) { return fs::equivalent(d, file, none); });
}

void BodyDrawings::Write(const std::string& image, const std::vector<std::string>& inputs,
                         std::string_view png) {
  const std::string stem = fs::path(image).stem();
  std::string file = fs::path(folder_) / (stem + "-body.png");
  for (int n = 2; drawn_.contains(file); ++n)
    file = fs::path(folder_) / fmt::format("{}-{}-body.png", stem, n);
  RefuseToReplace(file, inputs, force_);
  WriteWhole(file, png);
  drawn_.insert(file);
}

}  // namespace priamos::head
