#include "bus/radio/frame/reed_solomon.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "common/random.hpp"

namespace priamos::bus::radio {
namespace {

using Word = std::vector<std::uint8_t>;

Word RandomWord(Rng& rng, std::size_t data_symbols) {
  Word word(data_symbols);
  for (std::uint8_t& symbol : word) symbol = static_cast<std::uint8_t>(rng.Below(128));
  const auto parity = ReedSolomonParity(word);
  word.insert(word.end(), parity.begin(), parity.end());
  return word;
}

/// Different places of a word, in any order.
std::vector<std::size_t> Places(Rng& rng, std::size_t count, std::size_t symbols) {
  std::vector<std::size_t> places(symbols);
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::shuffle(places.begin(), places.end(), rng.engine());
  places.resize(count);
  return places;
}

RC_GTEST_PROP(ReedSolomon, CorrectsWhatItsDistanceAllows, (std::uint64_t seed)) {
  Rng rng(seed);
  const Word sent = RandomWord(rng, 1 + rng.Below(kMaxWordSymbols - kParitySymbols));
  const std::size_t most = std::min(kParitySymbols, sent.size());
  const std::size_t missing_count = rng.Below(most + 1);
  const std::size_t wrong_count = rng.Below((most - missing_count) / 2 + 1);
  const auto places = Places(rng, missing_count + wrong_count, sent.size());
  Word came = sent;
  for (std::size_t i = 0; i < places.size(); ++i)
    came[places[i]] ^= static_cast<std::uint8_t>(i < missing_count ? rng.Below(128) : 1 + rng.Below(127));
  const std::vector<std::size_t> missing(places.begin(),
                                         places.begin() + static_cast<std::ptrdiff_t>(missing_count));
  RC_ASSERT(ReedSolomonCorrect(came, missing));
  RC_ASSERT(came == sent);
}

RC_GTEST_PROP(ReedSolomon, WhatItAcceptsIsAWordOfTheCode, (std::uint64_t seed)) {
  Rng rng(seed);
  Word word(21);
  for (std::uint8_t& symbol : word) symbol = static_cast<std::uint8_t>(rng.Below(128));
  const auto missing = Places(rng, rng.Below(9), word.size());
  if (!ReedSolomonCorrect(word, missing)) return;
  const auto parity = ReedSolomonParity(std::span(word).first(word.size() - kParitySymbols));
  RC_ASSERT(std::equal(parity.begin(), parity.end(), word.end() - kParitySymbols));
}

// Of all words that many lie near one of the code: Blahut, 1983, 7.4.
TEST(ReedSolomon, RefusesNearlyAllRandomWords) {
  Rng rng(1);
  int accepted = 0;
  for (int i = 0; i < 100'000; ++i) {
    Word word(21);
    for (std::uint8_t& symbol : word) symbol = static_cast<std::uint8_t>(rng.Below(128));
    accepted += ReedSolomonCorrect(word, {}) ? 1 : 0;
  }
  EXPECT_LE(accepted, 10);
}

TEST(ReedSolomon, RefusesMoreMissingSymbolsThanParity) {
  Rng rng(1);
  Word word = RandomWord(rng, 13);
  const auto missing = Places(rng, kParitySymbols + 1, word.size());
  word[missing[0]] ^= 1;
  EXPECT_FALSE(ReedSolomonCorrect(word, missing));
}

}  // namespace
}  // namespace priamos::bus::radio
