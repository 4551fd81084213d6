#include "modules/diffraction/bake/kernel_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

constexpr std::size_t kWeightFloats = 12;

}  // namespace

KernelCells::KernelCells(const KernelTable& kernel, double pitch_nm, int views, const glm::dmat3& zero_order_xyz)
    : views_(views), cells_(2 * (views - 1)) {
    ROWLAND_CHECK_OP(views, >=, 2);
    ROWLAND_CHECK_OP(pitch_nm, >, 0.0);
    const int sums = 2 * cells_;
    const double step = 2.0 / cells_;
    const double density = 1.0 / step;
    weights_.assign(static_cast<std::size_t>(sums) * kWeightFloats, 0.0F);
    first_ = sums;
    for (int sum = 0; sum < sums; ++sum) {
        const double begin = pitch_nm * (sum * step - 2.0);
        const double end = pitch_nm * ((sum + 1) * step - 2.0);
        const glm::dmat3 weight = density * (kernel.at(end) - kernel.at(begin));
        bool any = false;
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) {
                const auto at = static_cast<std::size_t>(sum) * kWeightFloats + static_cast<std::size_t>(4 * c + o);
                weights_[at] = static_cast<float>(weight[c][o]);
                any = any || weights_[at] != 0.0F;
            }
        if (!any) continue;
        first_ = std::min(first_, sum);
        end_ = sum + 1;
    }
    // Order 0, δ(u), is spread over the four cells around u = 0; with fewer the image shows single texels.
    if (zero_order_xyz == glm::dmat3(0.0)) return;
    for (int sum = sums / 2 - 2; sum < sums / 2 + 2; ++sum) {
        const double fraction = sum == sums / 2 - 1 || sum == sums / 2 ? 0.375 : 0.125;
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o)
                weights_[static_cast<std::size_t>(sum) * kWeightFloats + static_cast<std::size_t>(4 * c + o)] +=
                    static_cast<float>(fraction * density * zero_order_xyz[c][o]);
        first_ = std::min(first_, sum);
        end_ = std::max(end_, sum + 1);
    }
}

KernelCells::Range KernelCells::range(int view) const {
    return {std::clamp(first_ - 2 * view, 0, cells_), std::clamp(end_ - 2 * view, 0, cells_)};
}

template <typename Value>
void KernelCells::sharpen(std::span<Value> xyz, std::size_t count) const {
    std::vector<Value> before(xyz.begin(), xyz.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = count; i + count < xyz.size(); ++i) {
        const Value here = xyz[i];
        Value& left = before[i % count];
        xyz[i] -= kBestView * (left - 2.0F * here + xyz[i + count]);
        left = here;
    }
}

template <int kFours>
void KernelCells::correlate(std::span<const Four> light, std::span<Four> xyz) const {
    constexpr std::size_t kSums = kFours % 10 == 0 ? 10 : 12;  // as many as registers hold
    static_assert(kFours % kSums == 0);
    for (int view = 0; view < views_; ++view) {
        const Range reached = range(view);
        for (std::size_t i = 0; i < 3 * kFours; i += kSums) {
            const float* weight =
                weights_.data() + static_cast<std::size_t>(reached.begin + 2 * view) * kWeightFloats + i / kFours;
            const Four* from = light.data() + static_cast<std::size_t>(reached.begin) * 3 * kFours + i % kFours;
            std::array<Four, kSums> sum{};
            for (int cell = reached.begin; cell < reached.end;
                 ++cell, weight += kWeightFloats, from += std::ptrdiff_t{3} * kFours)
                for (std::size_t k = 0; k < kSums; ++k)
                    sum[k] += weight[0] * from[k] + weight[4] * from[kFours + k] + weight[8] * from[2 * kFours + k];
            std::copy(sum.begin(), sum.end(),
                      xyz.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(view) * 3 * kFours + i));
        }
    }
    sharpen(xyz, std::size_t{3} * kFours);
}

template void KernelCells::correlate<10>(std::span<const Four> light, std::span<Four> xyz) const;
template void KernelCells::correlate<20>(std::span<const Four> light, std::span<Four> xyz) const;
template void KernelCells::correlate<24>(std::span<const Four> light, std::span<Four> xyz) const;

void KernelCells::correlate_rgb(std::span<const float> light, std::span<float> xyz) const {
    for (int view = 0; view < views_; ++view) {
        std::array<float, 4> sum{};
        const Range reached = range(view);
        const float* weight = weights_.data() + static_cast<std::size_t>(reached.begin + 2 * view) * kWeightFloats;
        const float* from = light.data() + static_cast<std::size_t>(reached.begin) * 4;
        for (int cell = reached.begin; cell < reached.end; ++cell, weight += kWeightFloats, from += 4)
            for (std::size_t o = 0; o < 4; ++o)
                sum[o] += weight[o] * from[0] + weight[4 + o] * from[1] + weight[8 + o] * from[2];
        std::copy(sum.begin(), sum.end(), xyz.begin() + static_cast<std::ptrdiff_t>(view) * 4);
    }
    sharpen(xyz, 4);
}

}  // namespace rowland::diffraction
