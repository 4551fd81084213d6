#include "engine/gpu/software_renderer.h"

#include <algorithm>
#include <array>

namespace rowland::gpu {

bool is_software_renderer(std::string_view renderer) {
    constexpr std::array names{"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"};
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return renderer.find(name) != std::string_view::npos; });
}

}  // namespace rowland::gpu
