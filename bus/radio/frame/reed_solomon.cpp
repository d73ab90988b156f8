#include "bus/radio/frame/reed_solomon.hpp"

#include <algorithm>

namespace priamos::bus::radio {
namespace {

/// Nonzero elements of the field, which are the powers of a = x.
constexpr std::size_t kOrder = 127;
/// x^7 + x^3 + 1, which is primitive.
constexpr unsigned kPolynomial = 0x89;

struct Field {
  std::array<std::uint8_t, 2 * kOrder> power{};  ///< a^i; twice, so that sums of logarithms need no modulo
  std::array<std::uint8_t, kOrder + 1> log{};
};

constexpr Field MakeField() {
  Field field;
  unsigned value = 1;
  for (std::size_t i = 0; i < kOrder; ++i) {
    field.power[i] = field.power[i + kOrder] = static_cast<std::uint8_t>(value);
    field.log[value] = static_cast<std::uint8_t>(i);
    value <<= 1;
    if (value > kOrder) value ^= kPolynomial;
  }
  return field;
}
constexpr Field kField = MakeField();

constexpr std::uint8_t Times(std::uint8_t a, std::uint8_t b) {
  if (a == 0 || b == 0) return 0;
  return kField.power[std::size_t{kField.log[a]} + kField.log[b]];
}
constexpr std::uint8_t Inverse(std::uint8_t a) {
  return kField.power[kOrder - kField.log[a]];
}
/// a^exponent.
constexpr std::uint8_t Power(std::size_t exponent) {
  return kField.power[exponent % kOrder];
}

/// Coefficients, the lowest first, of a polynomial whose degree is at most the number of parity symbols.
using Polynomial = std::array<std::uint8_t, kParitySymbols + 1>;

std::uint8_t ValueAt(const Polynomial& p, std::uint8_t x) {
  std::uint8_t value = 0;
  for (std::size_t i = p.size(); i-- > 0;) value = Times(value, x) ^ p[i];
  return value;
}

/// p multiplied by c x.
Polynomial TimesX(const Polynomial& p, std::uint8_t c) {
  Polynomial out{};
  for (std::size_t i = 1; i < p.size(); ++i) out[i] = Times(p[i - 1], c);
  return out;
}

Polynomial Sum(Polynomial a, const Polynomial& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] ^= b[i];
  return a;
}

std::size_t DegreeOf(const Polynomial& p) {
  std::size_t degree = p.size() - 1;
  while (degree > 0 && p[degree] == 0) --degree;
  return degree;
}

/// The product of (x - a^i) for i from 1 to the number of parity symbols.
constexpr Polynomial MakeGenerator() {
  Polynomial g{1};
  for (std::size_t root = 1; root <= kParitySymbols; ++root) {
    Polynomial next{};
    for (std::size_t i = 0; i < root; ++i) {
      next[i + 1] ^= g[i];
      next[i] ^= Times(g[i], Power(root));
    }
    g = next;
  }
  return g;
}
constexpr Polynomial kGenerator = MakeGenerator();

/// Number by which a place in the word is located: a to the power of its distance from the end.
std::uint8_t LocatorOf(std::size_t place, std::size_t symbols) {
  return Power(symbols - 1 - place);
}

/// Values of the word at the roots of the generator, as a polynomial; all zero: a word of the code.
Polynomial SyndromesOf(std::span<const std::uint8_t> word) {
  Polynomial syndromes{};
  for (std::size_t i = 0; i < kParitySymbols; ++i)
    for (const std::uint8_t symbol : word) syndromes[i] = Times(syndromes[i], Power(i + 1)) ^ symbol;
  return syndromes;
}

bool AllZero(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(), [](std::uint8_t c) { return c == 0; });
}

/// The polynomial whose roots are the inverses of the locators of all wrong places: Berlekamp and Massey's
/// algorithm, begun with the missing ones (Blahut: Theory and Practice of Error Control Codes, 1983, 9.2).
Polynomial ErrorLocator(const Polynomial& syndromes, Polynomial missing, std::size_t number_missing) {
  Polynomial locator = missing, previous = missing;
  std::size_t length = number_missing;
  for (std::size_t r = number_missing + 1; r <= kParitySymbols; ++r) {
    std::uint8_t discrepancy = 0;
    for (std::size_t i = 0; i < r; ++i) discrepancy ^= Times(locator[i], syndromes[r - 1 - i]);
    const Polynomial next = Sum(locator, TimesX(previous, discrepancy));
    if (discrepancy != 0 && 2 * length < r + number_missing) {
      length = r + number_missing - length;
      for (std::size_t i = 0; i < locator.size(); ++i) previous[i] = Times(locator[i], Inverse(discrepancy));
    } else {
      previous = TimesX(previous, 1);
    }
    locator = next;
  }
  return locator;
}

/// Product of two polynomials without the powers above those of the syndromes.
Polynomial Evaluator(const Polynomial& syndromes, const Polynomial& locator) {
  Polynomial product{};
  for (std::size_t i = 0; i < kParitySymbols; ++i)
    for (std::size_t j = 0; i + j < kParitySymbols; ++j) product[i + j] ^= Times(syndromes[i], locator[j]);
  return product;
}

Polynomial Derivative(const Polynomial& p) {
  Polynomial derivative{};
  for (std::size_t i = 1; i < p.size(); i += 2) derivative[i - 1] = p[i];
  return derivative;
}

}  // namespace

std::array<std::uint8_t, kParitySymbols> ReedSolomonParity(std::span<const std::uint8_t> data) {
  std::array<std::uint8_t, kParitySymbols> remainder{};
  for (const std::uint8_t symbol : data) {
    const std::uint8_t quotient = symbol ^ remainder[0];
    std::shift_left(remainder.begin(), remainder.end(), 1);
    remainder.back() = 0;
    for (std::size_t i = 0; i < kParitySymbols; ++i)
      remainder[i] ^= Times(quotient, kGenerator[kParitySymbols - 1 - i]);
  }
  return remainder;
}

bool ReedSolomonCorrect(std::span<std::uint8_t> word, std::span<const std::size_t> missing) {
  if (missing.size() > kParitySymbols) return false;
  const Polynomial syndromes = SyndromesOf(word);
  if (AllZero(syndromes)) return true;
  Polynomial missing_locator{1};
  for (const std::size_t place : missing)
    missing_locator = Sum(missing_locator, TimesX(missing_locator, LocatorOf(place, word.size())));
  const Polynomial locator = ErrorLocator(syndromes, missing_locator, missing.size());
  const Polynomial evaluator = Evaluator(syndromes, locator), derivative = Derivative(locator);
  std::size_t found = 0;
  for (std::size_t place = 0; place < word.size(); ++place) {
    const std::uint8_t x = Inverse(LocatorOf(place, word.size()));
    if (ValueAt(locator, x) != 0) continue;
    const std::uint8_t slope = ValueAt(derivative, x);
    if (slope == 0) return false;
    word[place] ^= Times(ValueAt(evaluator, x), Inverse(slope));
    ++found;
  }
  return found == DegreeOf(locator) && AllZero(SyndromesOf(word));
}

}  // namespace priamos::bus::radio
