#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Bytes as text, for JSON.
namespace priamos::bus {

/// True for well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates).
bool IsUtf8(std::string_view text);
/// The text as well-formed UTF-8: each byte that belongs to none is taken for Latin-1 (ISO 8859-1), those
/// that are no character there become U+FFFD.
std::string Utf8Of(std::string_view text);

/// RFC 4648 base64 with padding.
std::string ToBase64(std::span<const std::byte> bytes);
/// Bytes of a base64 text with padding (RFC 4648); nullopt when the text is none.
std::optional<std::vector<std::byte>> FromBase64(std::string_view text);

}  // namespace priamos::bus
