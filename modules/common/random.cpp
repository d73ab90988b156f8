#include "common/random.hpp"

#include "common/text/text_hash.hpp"

namespace priamos {

Rng Rng::Stream(std::uint64_t seed, std::string_view part) {
  // splitmix64: neighbouring seeds and names give unrelated streams.
  std::uint64_t z = seed + TextHash64(part) + 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return Rng(z ^ (z >> 31));
}

}  // namespace priamos
