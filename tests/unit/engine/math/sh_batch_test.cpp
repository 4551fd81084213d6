#include "engine/math/sh_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/sh_basis.h"
#include "tests/unit/engine/math/directions.h"
#include "tests/unit/engine/math/instruction_sets.h"

namespace rowland::math {
namespace {

struct Directions {
    std::array<std::vector<float>, 3> axis;

    explicit Directions(int count) {
        for (const glm::dvec3& d : test::scattered_directions(count)) add(d);
        for (const double tilt : {1e-3, 1e-5, 1e-20}) add(glm::normalize(glm::dvec3(tilt, -2 * tilt, 1)));
    }
    std::size_t size() const { return axis[0].size(); }
    std::array<std::span<const float>, 3> spans(std::size_t count) const {
        return {std::span(axis[0]).first(count), std::span(axis[1]).first(count), std::span(axis[2]).first(count)};
    }

 private:
    void add(const glm::dvec3& d) {
        for (int i = 0; i < 3; ++i) axis[static_cast<std::size_t>(i)].push_back(static_cast<float>(d[i]));
    }
};

class ShBatch : public test::OnInstructionSet {};

/// Largest difference from evaluate_sh() over many directions.
double largest_error(int bands, InstructionSet set) {
    const Directions directions(3000);
    const std::size_t count = directions.size();
    const auto functions = static_cast<std::size_t>(sh_count(bands));
    std::vector<float> fast(functions * count);
    evaluate_sh_batch(directions.spans(count), bands, count, fast, set);
    std::vector<double> slow(functions);
    double worst = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const auto& d = directions.axis;
        evaluate_sh({d[0][k], d[1][k], d[2][k]}, bands, slow);
        for (std::size_t i = 0; i < functions; ++i)
            worst = std::max(worst, std::abs(static_cast<double>(fast[i * count + k]) - slow[i]));
    }
    return worst;
}

TEST_P(ShBatch, AgreesWithTheSlowBasis) {
    for (int bands = 1; bands <= kMaximumFastBands; ++bands)
        // Rounding of floats: the header's bounds. sh_basis.cpp itself is held to published values.
        EXPECT_LT(largest_error(bands, GetParam()), bands <= 5 ? 1e-6 : 4e-6) << bands << " bands";
}

TEST_P(ShBatch, AnyCountAndStrideWritesJustItsOwnPlaces) {
    const Directions directions(20);
    constexpr std::size_t kStride = 23;
    // The wide copy alone is free to contract, and does the last few otherwise than whole vectors.
    const float rounding = GetParam() == InstructionSet::Avx2 ? 1e-6F : 0.0F;
    std::vector<float> all(25 * kStride);
    evaluate_sh_batch(directions.spans(kStride), 5, kStride, all, GetParam());
    for (std::size_t count = 0; count < kStride; ++count) {
        std::vector<float> some(25 * kStride, -9.0F);
        evaluate_sh_batch(directions.spans(count), 5, kStride, some, GetParam());
        for (std::size_t i = 0; i < 25; ++i)
            for (std::size_t k = 0; k < kStride; ++k)
                EXPECT_NEAR(some[i * kStride + k], k < count ? all[i * kStride + k] : -9.0F,
                            k < count ? rounding : 0.0F)
                    << count << ", " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(, ShBatch, test::kInstructionSets, test::name_of_instruction_set);

TEST(ShBatchDeathTest, RefusesRowsThatOverlap) {
    const Directions directions(20);
    std::vector<float> values(std::size_t{25} * 20);
    EXPECT_DEATH(evaluate_sh_batch(directions.spans(20), 5, 19, values), "stride");
}

}  // namespace
}  // namespace rowland::math
