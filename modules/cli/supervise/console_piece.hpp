#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace priamos::cli {

/// Some of the lines that a process wrote.
struct ConsolePiece {
  std::int64_t begin = 0;  ///< [byte] where in the console it begins
  std::string text;        ///< UTF-8 without control characters, but for the ends of lines
};

/// The last lines of `window` that are no longer than `most` bytes together; of a longer line its end.
/// `begin`: [byte] where the window begins in the console. What is no UTF-8, or would steer a terminal,
/// becomes "?".
ConsolePiece LastLines(std::string_view window, std::int64_t begin, std::size_t most);

/// The lines of a console that end at `end` [byte], at most `most` bytes; 0, or more than there is: the last
/// ones. nullopt when the file cannot be read.
std::optional<ConsolePiece> ReadConsolePiece(const std::string& file, std::int64_t end, std::size_t most);

}  // namespace priamos::cli
