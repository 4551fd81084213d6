#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/fuzz/format.h"

namespace rowland::fuzz {

struct Seed {
    std::string name;
    std::vector<std::byte> bytes;
};

/// Sound and unsound files of a format: those of `content/`, those of the test data folder if it is there, and for the
/// cooked formats a few made now.
std::vector<Seed> seeds(const Format& format);

}  // namespace rowland::fuzz
