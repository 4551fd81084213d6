#include "engine/math/frame_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "engine/math/spherical_harmonics.h"
#include "tests/support/threads.h"
#include "tests/unit/engine/math/directions.h"

namespace rowland::math {
namespace {

/// A test that runs once per instruction set, and is skipped where the processor lacks it.
class OnInstructionSet : public testing::TestWithParam<InstructionSet> {
 protected:
    void SetUp() override {
        if (!is_supported(GetParam())) GTEST_SKIP() << "this processor lacks it";
    }
};

const auto kInstructionSets = testing::Values(InstructionSet::Baseline, InstructionSet::Avx2);

std::string name_of_instruction_set(const testing::TestParamInfo<InstructionSet>& info) {
    return instruction_set_name(info.param);
}

/// Tangents and normals in arrays; tangent i and normal i need not be perpendicular.
struct Frames {
    std::array<std::vector<float>, 3> tangent;
    std::array<std::vector<float>, 3> normal;

    void add(const glm::dvec3& g, const glm::dvec3& n) {
        for (int i = 0; i < 3; ++i) {
            tangent[static_cast<std::size_t>(i)].push_back(static_cast<float>(g[i]));
            normal[static_cast<std::size_t>(i)].push_back(static_cast<float>(n[i]));
        }
    }
    std::size_t size() const { return normal[0].size(); }
    FrameArrays arrays(std::size_t count) const {
        FrameArrays result;
        for (std::size_t i = 0; i < 3; ++i) {
            result.tangent[i] = std::span(tangent[i]).first(count);
            result.normal[i] = std::span(normal[i]).first(count);
        }
        return result;
    }
    FrameArrays arrays() const { return arrays(size()); }
    /// The frame's axes as rows, in double, of the numbers as they are stored.
    glm::dmat3 rows(std::size_t i) const {
        const glm::dvec3 n = glm::normalize(glm::dvec3(normal[0][i], normal[1][i], normal[2][i]));
        const glm::dvec3 along(tangent[0][i], tangent[1][i], tangent[2][i]);
        const glm::dvec3 g = glm::normalize(along - n * glm::dot(n, along));
        return glm::transpose(glm::dmat3(g, glm::cross(n, g), n));
    }
};

/// Hard turns, near-identities of all sizes, random turns, and frames that are skewed and not of unit length: more than
/// one task rotates.
Frames many_frames() {
    Frames frames;
    const auto add = [&frames](const glm::dmat3& rows) {
        const glm::dmat3 axes = glm::transpose(rows);
        frames.add(axes[0], axes[2]);
    };
    for (const glm::dmat3& m : test::hard_rotations()) add(m);
    std::mt19937_64 random(23);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    for (double angle = 1; angle > 1e-12; angle /= 3) {
        add(test::rotation_about(vector(), angle));
        add(test::rotation_about({0, 1, 0}, std::numbers::pi - angle));
    }
    for (int i = 0; i < 600; ++i) add(test::rotation_about(vector(), 3 * normal(random)));
    for (int i = 0; i < 50; ++i) frames.add(vector() * 1e-3, vector() * 1e3);
    return frames;
}

std::vector<glm::dvec3> random_light(int bands) {
    std::mt19937_64 random(static_cast<unsigned>(bands));
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> light;
    for (int i = 0; i < sh_count(bands); ++i) light.emplace_back(normal(random), normal(random), normal(random));
    return light;
}

double norm(const std::vector<glm::dvec3>& values) {
    double sum = 0;
    for (const glm::dvec3& v : values) sum += glm::dot(v, v);
    return std::sqrt(sum);
}

/// √Σ‖fast − slow‖² for the RGB triples of one frame.
double distance(const float* fast, const std::vector<glm::dvec3>& slow) {
    double sum = 0;
    for (const glm::dvec3& rgb : slow)
        for (int c = 0; c < 3; ++c) sum += std::pow(static_cast<double>(*fast++) - rgb[c], 2);
    return std::sqrt(sum);
}

std::vector<glm::dvec3> slowly_rotated(const std::vector<glm::dvec3>& light, int bands, const glm::dmat3& rows) {
    std::vector<glm::dvec3> rotated(light.size());
    ShRotation(rows, bands).apply(std::span<const glm::dvec3>(light), rotated);
    return rotated;
}

class FrameRotation : public OnInstructionSet {};

TEST_P(FrameRotation, AgreesWithTheSlowRotation) {
    const Frames frames = many_frames();
    for (int bands = 1; bands <= kMaximumFastBands; ++bands) {
        const auto light = random_light(bands);
        std::vector<float> fast(frames.size() * light.size() * 3);
        rotate_to_frames(light, bands, frames.arrays(), fast, GetParam());
        for (std::size_t i = 0; i < frames.size(); ++i)
            // The header's bound: rounding of floats in five steps, the turns' sines taken at 15 times the angle.
            EXPECT_LT(distance(&fast[i * light.size() * 3], slowly_rotated(light, bands, frames.rows(i))),
                      2e-6 * norm(light))
                << bands << " bands, frame " << i;
    }
}

TEST_P(FrameRotation, ATiltedFrameSeesTheLightFromItsOwnAxes) {
    // A light straight along world x, seen in the frame g = z, n = x, is straight along the frame's n.
    Frames frames;
    frames.add({0, 0, 1}, {1, 0, 0});
    std::vector<glm::dvec3> light(4, glm::dvec3(0.0));
    light[static_cast<std::size_t>(sh_index(1, 1))] = {1, 2, 3};
    std::vector<float> out(12);
    rotate_to_frames(light, 2, frames.arrays(), out, GetParam());
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(out[i * 3 + c],
                        i == static_cast<std::size_t>(sh_index(1, 0)) ? 1.0 + static_cast<double>(c) : 0, 1e-6);
}

TEST_P(FrameRotation, AnyNumberOfFramesGivesEachTheSameNumbers) {
    const Frames frames = many_frames();
    const auto light = random_light(5);
    std::vector<float> all(frames.size() * 75);
    rotate_to_frames(light, 5, frames.arrays(), all, GetParam());
    for (const std::size_t count : {0u, 1u, 3u, 4u, 7u, 8u, 9u, 31u}) {
        std::vector<float> some(count * 75 + 1, -9.0F);
        rotate_to_frames(light, 5, frames.arrays(count), some, GetParam());
        EXPECT_EQ(std::memcmp(some.data(), all.data(), count * 75 * sizeof(float)), 0) << count;
        EXPECT_EQ(some.back(), -9.0F) << "wrote past frame " << count;
    }
}

TEST_P(FrameRotation, DoesNotDependOnTheNumberOfThreads) {
    Frames frames;
    for (int i = 0; i < 20; ++i) {
        const Frames more = many_frames();
        for (std::size_t k = 0; k < more.size(); ++k)
            frames.add({more.tangent[0][k], more.tangent[1][k], more.tangent[2][k]},
                       {more.normal[0][k], more.normal[1][k], more.normal[2][k]});
    }
    const auto light = random_light(4);
    rowland::test::expect_same_on_any_threads([&] {
        std::vector<float> result(frames.size() * light.size() * 3);
        rotate_to_frames(light, 4, frames.arrays(), result, GetParam());
        return result;
    });
}

TEST_P(FrameRotation, DegenerateFramesGiveFiniteLightOfTheSameNorm) {
    Frames frames;
    frames.add({0, 0, 1}, {0, 0, 1});
    frames.add({0, 0, 0}, {0.6, 0, 0.8});
    frames.add({1, 2, 3}, {2, 4, 6});
    frames.add({0, 0, 0}, {0, 0, 0});
    const auto light = random_light(8);
    std::vector<float> out(frames.size() * light.size() * 3);
    rotate_to_frames(light, 8, frames.arrays(), out, GetParam());
    const std::vector<glm::dvec3> nothing(light.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_NEAR(distance(&out[i * light.size() * 3], nothing), norm(light), 2e-6 * norm(light)) << i;
}

TEST_P(FrameRotation, ProjectionEqualsTheMatrixTimesTheRotatedLight) {
    const Frames frames = many_frames();
    for (int bands = 1; bands <= kMaximumFastBands; ++bands) {
        const auto light = random_light(bands);
        const std::size_t rows = static_cast<std::size_t>(2 * bands - 1);
        // Two thirds zeros, and one row of nothing else.
        std::vector<double> matrix(rows * light.size());
        double largest_row = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            double squared = 0;
            for (std::size_t i = 0; i < light.size(); ++i) {
                const bool zero = row == 3 || (row + i) % 3 != 0;
                matrix[row * light.size() + i] = zero ? 0.0 : std::cos(static_cast<double>(row * 7 + i));
                squared += std::pow(matrix[row * light.size() + i], 2);
            }
            largest_row = std::max(largest_row, std::sqrt(squared));
        }
        std::vector<float> fast(frames.size() * rows * 3);
        rotate_and_project(light, frames.arrays(), FrameProjection(matrix, bands), fast, GetParam());
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const auto rotated = slowly_rotated(light, bands, frames.rows(i));
            for (std::size_t row = 0; row < rows; ++row) {
                glm::dvec3 sum(0.0);
                for (std::size_t k = 0; k < light.size(); ++k) sum += matrix[row * light.size() + k] * rotated[k];
                const float* rgb = &fast[(i * rows + row) * 3];
                // The rotation's 2e-6 through a row of that norm, and as much for the sum itself.
                EXPECT_LT(glm::length(glm::dvec3(rgb[0], rgb[1], rgb[2]) - sum), 4e-6 * largest_row * norm(light))
                    << bands << " bands, frame " << i << ", row " << row;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(, FrameRotation, kInstructionSets, name_of_instruction_set);

TEST(FrameProjection, KeepsNoZeros) {
    const std::vector<double> matrix = {0, 2, 0, 1e-12, 0, 0, 0, 0, 0, 0, -1, 3};
    const FrameProjection projection(matrix, 2);
    EXPECT_EQ(projection.rows(), 3);
    EXPECT_EQ(projection.entries(), 3);
    EXPECT_EQ(projection.column()[2], 3);
}

TEST(FrameProjectionDeathTest, RefusesPartOfARow) {
    EXPECT_DEATH(FrameProjection(std::vector<double>(6, 1.0), 2), "whole rows");
}

TEST(FrameRotationDeathTest, RefusesFramesOfUnequalArrays) {
    Frames frames = many_frames();
    frames.tangent[1].pop_back();
    FrameArrays arrays;
    for (std::size_t i = 0; i < 3; ++i) {
        arrays.tangent[i] = frames.tangent[i];
        arrays.normal[i] = frames.normal[i];
    }
    std::vector<float> out(frames.size() * 12);
    EXPECT_DEATH(rotate_to_frames(random_light(2), 2, arrays, out), "tangent");
}

}  // namespace
}  // namespace rowland::math
