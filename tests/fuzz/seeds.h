#pragma once

#include "tests/fuzz/format.h"

namespace rowland::fuzz {

struct Seed {
    std::string name;
    std::vector<std::byte> bytes;
};

/// Sound and unsound files of a format: those of `corpus/`, which once did harm, those of `content/`, those of the test
/// data folder if it is there, and a few small ones made now.
std::vector<Seed> seeds(const Format& format);

}  // namespace rowland::fuzz
