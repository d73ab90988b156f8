#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace priamos::head {

/// What is wrong with the first line of a mesh that cannot be read: "LINE: v: expected ..., got ..."; nullopt
/// when there is none. Wavefront text (.obj): places and the faces between them; the text form of .stl.
/// Assimp takes what is no number for 0, and so makes another body of it.
std::optional<std::string> WrongLineOfObj(std::string_view text);
std::optional<std::string> WrongLineOfStl(std::string_view text);

}  // namespace priamos::head
