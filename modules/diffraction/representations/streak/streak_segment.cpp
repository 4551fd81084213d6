#include "modules/diffraction/representations/streak/streak_segment.h"

#include <cmath>

namespace rowland::diffraction {

bool is_valid(const StreakSegment& segment) {
    bool valid = std::isfinite(segment.first_nm) && std::isfinite(segment.step_nm) && segment.step_nm >= 0.0F;
    for (const glm::mat3& weight : segment.weights)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i) valid = valid && std::isfinite(weight[c][i]);
    return valid;
}

double read_positive(ByteReader& reader, std::string_view name) {
    const auto x = reader.value<double>();
    if (!std::isfinite(x) || !(x > 0.0)) reader.fail(fmt::format("{} {}", name, x), "a number above 0");
    return x;
}

}  // namespace rowland::diffraction
