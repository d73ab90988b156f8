#pragma once

#include <string>
#include <string_view>

namespace priamos::console {

/// Names of the message schemas that the panels of Foxglove and Lichtblick draw, as far as a Scene writes
/// them (https://docs.foxglove.dev/docs/sdk/schemas).
inline constexpr std::string_view kFrameTransform = "foxglove.FrameTransform";
inline constexpr std::string_view kSceneUpdate = "foxglove.SceneUpdate";
inline constexpr std::string_view kPointCloud = "foxglove.PointCloud";
inline constexpr std::string_view kCompressedImage = "foxglove.CompressedImage";
inline constexpr std::string_view kImageAnnotations = "foxglove.ImageAnnotations";

/// JSON schema of one of them.
std::string SceneSchema(std::string_view name);

}  // namespace priamos::console
