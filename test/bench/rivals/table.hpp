#pragma once

#include <string>
#include <utility>
#include <vector>

#include "test/bench/rivals/drive.hpp"

namespace priamos::bench {

/// What a driver did in the cases of one family, in their order.
struct Row {
  std::string driver;
  std::vector<Drive> drives;
};

/// One line per driver, the first being the one that the others are compared with.
void PrintTable(const std::string& family, const std::vector<Row>& rows);

/// In which families, and in what, the first driver is beaten by which other.
std::vector<std::string> Defeats(const std::string& family, const std::vector<Row>& rows);

}  // namespace priamos::bench
