#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/random.hpp"

namespace priamos::world {

/// Many normal deviates quickly: four from every 64-bit draw of `rng`, by a table of the inverse distribution
/// with 65536 steps (so within +-4.2).
class NormalTable {
 public:
  explicit NormalTable(Rng& rng);
  double Draw();

 private:
  Rng& rng_;
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

}  // namespace priamos::world
