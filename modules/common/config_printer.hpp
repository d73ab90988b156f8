#pragma once

#include <iosfwd>
#include <memory>

#include "common/archive.hpp"

namespace priamos {

/// Writes an Archive's visit as commented TOML: what --print-config shows. Loading it gives the same values.
std::unique_ptr<Archive> MakeConfigPrinter(std::ostream& out);

template <class T>
void PrintConfig(std::ostream& out, T config) {
  config.Describe(*MakeConfigPrinter(out));
}

}  // namespace priamos
