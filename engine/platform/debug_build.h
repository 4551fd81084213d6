#pragma once

namespace rowland::platform {

/// Whether this library was compiled for debugging (without NDEBUG). Then contexts are debug contexts by default.
bool debug_build();

}  // namespace rowland::platform
