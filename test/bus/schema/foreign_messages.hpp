#pragma once

#include "foreign/deep/everything_t.hpp"

namespace priamos::bus {

/// A message with every kind of field filled, as other people's programs send it.
inline foreign::deep::everything_t FullMessage() {
  foreign::deep::everything_t m{};
  m.i8 = -128;
  m.i16 = -32768;
  m.i32 = -2147483647;
  m.second = 2;
  m.third[0] = 3;
  m.third[1] = 4;
  m.third[2] = 5;
  m.i64 = -9223372036854775807LL;
  m.f = 0.1F;
  m.d = 0.1;
  m.s = "text \"quoted\" \xC3\xA4";
  m.b = 1;
  m.raw = 200;
  for (int i = 0; i < 16; ++i) m.key[i] = static_cast<std::uint8_t>(16 * i);
  m.names[0] = "";
  m.names[1] = "second";
  m.n8 = 2;
  m.n16 = 1;
  m.n32 = 3;
  m.n64 = 4;
  m.blob = {1, 2, 255};
  m.doubles = {1e300, -0.0};
  m.flags = {1};
  m.grid.assign(2, std::vector<std::vector<float>>(3, std::vector<float>(4, 1.5F)));
  m.cube[1][1][1] = 7;
  m.words.assign(2, std::vector<std::string>(2, "w"));
  m.corner.x = 1;
  m.corners.assign(2, std::vector<foreign::point_t>(1));
  m.tree.name = "root";
  m.tree.n_children = 2;
  m.tree.children.resize(2);
  m.tree.children[0].name = "leaf";
  m.tree.children[1].n_children = 1;
  m.tree.children[1].children.resize(1);
  return m;
}

}  // namespace priamos::bus
