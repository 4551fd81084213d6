#include "engine/post/exposure.h"

#include <cmath>

namespace rowland::post {

float exposure_scale(float stops) {
    return std::exp2(stops);
}

void apply_exposure(std::span<glm::vec3> pixels, float stops) {
    const float scale = exposure_scale(stops);
    for (glm::vec3& pixel : pixels) pixel *= scale;
}

}  // namespace rowland::post
