#pragma once

#include <cstddef>
#include <string>

namespace rowland::demo {

/// Memory that the process has in use; 0 where the system does not say.
std::size_t resident_bytes();

/// "812 B", "3.4 KiB", "56 MiB": three digits at most before the unit.
std::string readable_bytes(std::size_t bytes);

}  // namespace rowland::demo
