// fejer.glsl against 60-digit arithmetic and against the CPU in double.
#include "modules/diffraction/model/fejer.h"

#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "engine/core/embedded_file.h"
#include "engine/gpu/buffer.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::diffraction {

std::span<const EmbeddedFile> fejer_shader_files();

namespace {

constexpr const char* kCompute = R"(#version 450 core
#include "modules/diffraction/shaders/fejer.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Arguments { vec2 arguments[]; };
layout(std430, binding = 1) writeonly buffer Ratios { float ratios[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < arguments.length()) ratios[i] = fejer(arguments[i].x, arguments[i].y);
}
)";

class GlslFejer : public rowland::test::GlTest {
 protected:
    /// fejer(N, δ) of every (N, δ), on the GPU.
    static std::vector<float> ratios(const std::vector<glm::vec2>& arguments) {
        gpu::ShaderLibrary library;
        library.add_embedded(fejer_shader_files());
        const std::array<EmbeddedFile, 1> own{{{"fejer_test.comp.glsl", kCompute}}};
        library.add_embedded(own);
        const gpu::Program program(library, {.compute = "fejer_test.comp.glsl"});
        const gpu::Buffer in = gpu::Buffer::of(std::span<const glm::vec2>(arguments));
        const gpu::Buffer out(arguments.size() * sizeof(float));
        in.bind_storage(0);
        out.bind_storage(1);
        program.dispatch(static_cast<unsigned>((arguments.size() + 63) / 64));
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        std::vector<float> result(arguments.size());
        glGetNamedBufferSubData(out.id(), 0, static_cast<GLsizeiptr>(result.size() * sizeof(float)), result.data());
        return result;
    }
};

/// PHYSICS §9: 1e-5 absolute in float.
TEST_F(GlslFejer, MatchesHighPrecision) {
    ROWLAND_TEST_DATA(path, "oracle/fejer_ratio.csv");
    const rowland::test::Csv oracle = rowland::test::read_csv(path);
    std::vector<glm::vec2> arguments;
    for (std::size_t row = 0; row < oracle.rows.size(); ++row)
        arguments.emplace_back(oracle.number(row, "N"), oracle.number(row, "delta"));
    ASSERT_GT(arguments.size(), 100U);
    const std::vector<float> found = ratios(arguments);
    double largest = 0.0;
    for (std::size_t row = 0; row < found.size(); ++row) {
        const double expected = oracle.number(row, "ratio");
        EXPECT_NEAR(static_cast<double>(found[row]), expected, 1e-5)
            << "N " << oracle.text(row, "N") << " delta " << oracle.text(row, "delta");
        largest = std::max(largest, std::abs(static_cast<double>(found[row]) - expected));
    }
    RecordProperty("largest_error", std::to_string(largest));
}

/// The same bound everywhere between: δ over twelve decades, at both ends of the series and of the period, for N from 1
/// to a million. The CPU takes the float δ as it is, so that only the evaluation differs.
TEST_F(GlslFejer, MatchesItsTwinEverywhere) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<glm::vec2> arguments;
    for (int i = 0; i < 200000; ++i) {
        const float grooves = std::round(std::pow(10.0F, 6.0F * uniform(random)));
        const float sign = i % 2 == 0 ? 1.0F : -1.0F;
        switch (i % 4) {
            case 0:
                arguments.emplace_back(grooves, sign * (uniform(random) - 0.5F));
                break;
            case 1:
                arguments.emplace_back(grooves, sign * std::pow(10.0F, -12.0F * uniform(random)));
                break;
            case 2:  // about the series' end
                arguments.emplace_back(grooves, sign * 1e-4F / grooves * (0.9F + 0.2F * uniform(random)));
                break;
            default:  // in the first lobes
                arguments.emplace_back(grooves, sign * 5.0F * uniform(random) / grooves);
        }
    }
    const std::vector<float> found = ratios(arguments);
    double largest = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto grooves = static_cast<double>(arguments[i].x);
        const auto delta = static_cast<double>(arguments[i].y);
        const double difference = std::abs(static_cast<double>(found[i]) - fejer(grooves, delta));
        ASSERT_LT(difference, 1e-5) << "N " << grooves << " delta " << delta;  // NaN fails as well
        largest = std::max(largest, difference);
    }
    RecordProperty("largest_error", std::to_string(largest));
}

TEST_F(GlslFejer, IsExactlyOneAtAPeakAndForOneGroove) {
    const std::vector<float> found =
        ratios({{1.0F, 0.0F}, {1500.0F, 0.0F}, {1e6F, 0.0F}, {1e6F, 3.0F}, {1.0F, 0.37F}, {1.0F, 0.5F}});
    for (const float ratio : found) EXPECT_NEAR(ratio, 1.0F, 1e-6F);
    EXPECT_EQ(found[0], 1.0F);
    EXPECT_EQ(found[2], 1.0F);
}

}  // namespace
}  // namespace rowland::diffraction
