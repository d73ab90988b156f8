#pragma once

/// What the command line may ask of the generator of worlds (`priamos world generate`).
#include "world/core/generate/generate.hpp"
