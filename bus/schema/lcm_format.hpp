#pragma once

#include <string>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// The definitions of `type` and of all types in it as one .lcm text. ParseLcm makes the same types of it:
/// names, fields, constants, annotations, fingerprints; each comment stands on one line.
std::string FormatLcm(const Struct& type);

}  // namespace priamos::bus
