#include "engine/platform/debug_build.h"

namespace rowland::platform {

bool debug_build() {
#ifdef NDEBUG
    return false;
#else
    return true;
#endif
}

}  // namespace rowland::platform
