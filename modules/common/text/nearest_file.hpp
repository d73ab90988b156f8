#pragma once

#include <string>
#include <string_view>

namespace priamos {

/// What a `path` that leads to no file probably means, as the end of a sentence: `; nearest:
/// "logs/a.lcmlog"`. Of the first of its components that does not exist, those that are near in its folder;
/// of a name whose ending alone is wrong, those with another ending. Of a folder, the files in it
/// that end in `ending`. Empty if
/// nothing is near.
std::string NearestFileText(const std::string& path, std::string_view ending);

}  // namespace priamos
