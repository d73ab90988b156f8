#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// Reed-Solomon code over the 128 numbers of 7 bits (Reed, Solomon: Journal of the SIAM 8(2), 1960), for
/// frames that must come through a line that damages most frames.
namespace priamos::bus::radio {

/// Symbols that follow the data. They correct e wrong and f missing symbols with 2 e + f <= 8.
inline constexpr std::size_t kParitySymbols = 8;
/// Symbols of the longest word, parity included.
inline constexpr std::size_t kMaxWordSymbols = 127;

/// The parity of data of at most kMaxWordSymbols - kParitySymbols symbols, each below 128.
std::array<std::uint8_t, kParitySymbols> ReedSolomonParity(std::span<const std::uint8_t> data);

/// Corrects a word, data and parity, in place. `missing`: places in the word that hold nothing of use. False
/// if no word is so near; the word is then undefined.
bool ReedSolomonCorrect(std::span<std::uint8_t> word, std::span<const std::size_t> missing);

}  // namespace priamos::bus::radio
