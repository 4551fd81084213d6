#include "editor/inspector/physics/kernel_strip.h"

#include <algorithm>

namespace rowland::inspector {

KernelStrip kernel_strip(const diffraction::KernelTable& kernel, double pitch_nm, int cells) {
    KernelStrip strip{.begin_nm = std::max(kernel.begin_nm, -2.0 * pitch_nm),
                      .end_nm = std::min(kernel.end_nm, 2.0 * pitch_nm),
                      .xyz = {}};
    if (!(strip.begin_nm < strip.end_nm)) return strip;
    const double cell = (strip.end_nm - strip.begin_nm) / cells;
    for (int i = 0; i < cells; ++i) {
        const double begin = strip.begin_nm + i * cell;
        strip.xyz.push_back(kernel.average(begin, begin + cell) * glm::dvec3(1.0));
    }
    return strip;
}

}  // namespace rowland::inspector
