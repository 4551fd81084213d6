#pragma once

#include <string>

#include "engine/cook/registry.h"
#include "engine/core/error.h"

namespace rowland::test {

/// Registers "tiles" (.tiles → .cooked), a line-based source for tests:
///   size N          the payload gets N bytes, computed in a parallel loop from all that is read
///   include FILE    also reads FILE, beside the source
///   refuse          the source is refused with an Error
///   crash           a library throws std::runtime_error
///   exhaust         a library runs out of memory
///   change FILE     somebody else writes to FILE, beside the source, while it is being cooked
///   hold FILE       the cook takes as long as there is FILE, beside the source; meanwhile there is FILE.reached
/// and "notes" (.notes), which are only checked and always sane, and "plain" (.plain → .flat), which is cooked to its
/// own bytes without a container. A glTF material holds tiles as the extension TEST_tiles, with all that was read.
void register_tile_types(cook::Registry& registry);

}  // namespace rowland::test
