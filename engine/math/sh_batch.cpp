#include "engine/math/sh_batch.h"

#include "engine/core/check.h"
#include "engine/math/sh_basis.h"
#include "engine/math/sh_recurrence.h"
#include "engine/math/simd/dispatch.h"

namespace rowland::math {

namespace {

simd::Recurrence single_precision_recurrence() {
    simd::Recurrence result{};
    const ShRecurrence& factors = sh_recurrence();
    for (std::size_t m = 0; m < std::size_t{kMaximumFastBands}; ++m) {
        result.diagonal[m] = static_cast<float>(factors.diagonal[m]);
        for (std::size_t l = m + 1; l < std::size_t{kMaximumFastBands}; ++l) {
            result.a[l * l + m] = static_cast<float>(factors.a[m][l]);
            result.b[l * l + m] = static_cast<float>(factors.b[m][l]);
        }
    }
    return result;
}

}  // namespace

void evaluate_sh_batch(const std::array<std::span<const float>, 3>& direction, int bands, std::size_t stride,
                       std::span<float> values, InstructionSet set) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    ROWLAND_CHECK_OP(bands, <=, kMaximumFastBands);
    const std::size_t count = direction[0].size();
    ROWLAND_CHECK_OP(direction[1].size(), ==, count);
    ROWLAND_CHECK_OP(direction[2].size(), ==, count);
    ROWLAND_CHECK_OP(stride, >=, count);
    ROWLAND_CHECK_OP(values.size(), >=, static_cast<std::size_t>(sh_count(bands) - 1) * stride + count);
    static const simd::Recurrence factors = single_precision_recurrence();
    simd::kernels(set).evaluate({direction[0].data(), direction[1].data(), direction[2].data(), count}, bands, factors,
                                stride, values.data());
}

}  // namespace rowland::math
