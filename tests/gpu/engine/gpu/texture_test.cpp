#include "engine/gpu/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <random>

#include "engine/gpu/pipeline_state.h"
#include "tests/gpu/gl_test.h"

namespace rowland {

namespace {

using TextureTest = test::GlTest;
using TextureDeathTest = test::GlTest;
using gpu::Format;
using gpu::TextureKind;

/// Values 0 to 65535 in a fixed random order.
std::vector<std::uint16_t> random_words(std::size_t count) {
    std::mt19937 random(7);
    std::vector<std::uint16_t> values(count);
    for (std::uint16_t& value : values) value = static_cast<std::uint16_t>(random() & 0xffffU);
    return values;
}

/// What a linear filter gives for normalised coordinates in one layer of an RGBA16 array, clamped at the edges.
glm::dvec4 bilinear(const std::vector<std::uint16_t>& texels, int width, int height, int layer, double s, double t) {
    const double x = s * width - 0.5;
    const double y = t * height - 0.5;
    const auto texel = [&](double column, double row) {
        const int i = std::clamp(static_cast<int>(column), 0, width - 1);
        const int j = std::clamp(static_cast<int>(row), 0, height - 1);
        const auto start = static_cast<std::size_t>(4 * ((layer * height + j) * width + i));
        return glm::dvec4(texels[start], texels[start + 1], texels[start + 2], texels[start + 3]) / 65535.0;
    };
    const double fx = x - std::floor(x);
    const double fy = y - std::floor(y);
    const double left = std::floor(x);
    const double low = std::floor(y);
    return (1 - fy) * ((1 - fx) * texel(left, low) + fx * texel(left + 1, low)) +
           fy * ((1 - fx) * texel(left, low + 1) + fx * texel(left + 1, low + 1));
}

TEST_F(TextureTest, Rgba16ArraySampledInAVertexShaderIsBilinear) {
    constexpr int width = 16;
    constexpr int height = 8;
    constexpr int layers = 5;
    constexpr int samples = 256;
    const std::vector<std::uint16_t> texels = random_words(std::size_t{4} * width * height * layers);
    gpu::Texture texture(
        {.kind = TextureKind::PlaneArray, .format = Format::RGBA16, .width = width, .height = height, .depth = layers});
    texture.upload(std::span<const std::uint16_t>(texels), {.layers = layers});

    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<glm::vec4> coordinates;
    for (int i = 0; i < samples; ++i) {
        coordinates.emplace_back(uniform(random), uniform(random), static_cast<float>(i % layers), 0.0F);
    }
    const gpu::Buffer coordinate_buffer = gpu::Buffer::of(std::span<const glm::vec4>(coordinates));
    gpu::VertexArray vertices;
    vertices.attach(coordinate_buffer, sizeof(glm::vec4), {{0, 3, 0}});
    glVertexArrayBindingDivisor(vertices.id(), 0, 1);  // a value per instance

    // Instance i covers pixel i of a line of pixels with the value its vertices fetched.
    const gpu::Program program = build(fmt::format(R"(#version 450 core
layout(location = 0) in vec3 coordinate;
layout(binding = 4) uniform sampler2DArray table;
flat out vec4 value;
void main() {{
    value = texture(table, coordinate);
    // A triangle of twice the pixel's height whose middle covers the pixel.
    float x = float(gl_InstanceID) + vec3(-0.5, 1.5, 0.5)[gl_VertexID];
    float y = vec3(-0.5, -0.5, 3.5)[gl_VertexID];
    gl_Position = vec4(2.0 * vec2(x / {}.0, y) - 1.0, 0.0, 1.0);
}})",
                                                   samples),
                                       R"(#version 450 core
flat in vec4 value;
layout(location = 0) out vec4 colour;
void main() { colour = value; })");
    const gpu::Framebuffer target({.width = samples, .height = 1, .colours = {Format::RGBA32F}});
    target.bind();
    target.clear(glm::vec4(-1.0F));
    gpu::apply({.depth_test = gpu::DepthTest::Off, .depth_write = false, .cull = gpu::Cull::None});
    texture.bind(4);
    program.use();
    vertices.draw(3, samples);

    const std::vector<glm::vec4> pixels = target.read_rgba_float();
    double worst = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::dvec4 expected =
            bilinear(texels, width, height, static_cast<int>(coordinates[i].z), coordinates[i].x, coordinates[i].y);
        for (int c = 0; c < 4; ++c) worst = std::max(worst, std::abs(pixels[i][c] - expected[c]));
    }
    // GPUs take 8 bits of a position, rounded or cut off: a step off on both axes, between texels that differ by up
    // to 1.
    EXPECT_LE(worst, 2.0 / 256.0);
}

TEST_F(TextureTest, HalfFloatsKeepTheirBits) {
    const std::vector<float> values{0.0F, 1.0F, -2.5F, 65504.0F, 6e-8F, 1.0F / 3.0F, 1e-3F, -0.125F};
    std::vector<std::uint16_t> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(), [](float value) { return glm::packHalf1x16(value); });
    gpu::Texture texture({.format = Format::RGBA16F, .width = 2, .height = 1});
    texture.upload(std::span<const std::uint16_t>(halves));
    const std::vector<glm::vec4> read = texture.read();
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(read[i / 4][static_cast<int>(i % 4)], glm::unpackHalf1x16(halves[i])) << values[i];
    }
}

TEST_F(TextureTest, HalfFloatsAreWholeTexels) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    gpu::Texture texture({.format = Format::RGBA16F, .width = 2, .height = 1});
    const std::vector<std::uint16_t> without_alpha(6);
    EXPECT_DEATH(texture.upload(std::span<const std::uint16_t>(without_alpha)), "contract violated.*12 and 16");
}

TEST_F(TextureTest, FloatsComeBackAsTheyWereInRowOrder) {
    const std::vector<glm::vec3> texels{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {-1, 0.1F, 1e30F}};
    gpu::Texture texture({.format = Format::RGBA32F, .width = 2, .height = 2});
    texture.upload(std::span<const glm::vec3>(texels));
    const std::vector<glm::vec4> read = texture.read();
    for (std::size_t i = 0; i < texels.size(); ++i) EXPECT_EQ(read[i], glm::vec4(texels[i], 1.0F)) << i;
}

TEST_F(TextureTest, LayersAndLevelsAreWrittenApart) {
    gpu::Texture texture(
        {.kind = TextureKind::PlaneArray, .format = Format::R32F, .width = 4, .height = 2, .depth = 3, .levels = 0});
    EXPECT_EQ(texture.levels(), 3);
    EXPECT_EQ(texture.size(1), glm::ivec2(2, 1));
    EXPECT_EQ(texture.size(2), glm::ivec2(1, 1));
    EXPECT_EQ(texture.bytes(), 4U * 3U * (8U + 2U + 1U));
    for (int layer = 0; layer < 3; ++layer) {
        texture.upload(std::vector<float>(8, static_cast<float>(layer)), {.layer = layer});
        texture.upload(std::vector<float>(2, 10.0F + static_cast<float>(layer)), {.level = 1, .layer = layer});
    }
    for (int layer = 0; layer < 3; ++layer) {
        EXPECT_EQ(texture.read({.layer = layer})[7].r, static_cast<float>(layer));
        EXPECT_EQ(texture.read({.level = 1, .layer = layer})[1].r, 10.0F + static_cast<float>(layer));
    }
}

TEST_F(TextureTest, GeneratedLevelsAreAverages) {
    gpu::Texture texture({.format = Format::R32F, .width = 2, .height = 2, .levels = 0});
    texture.upload(std::vector<float>{1.0F, 2.0F, 3.0F, 6.0F});
    texture.generate_levels();
    EXPECT_FLOAT_EQ(texture.read({.level = 1})[0].r, 3.0F);
}

TEST_F(TextureTest, VolumesAreSampledInAllThreeAxes) {
    std::vector<float> values(std::size_t{2} * 3 * 4);
    std::iota(values.begin(), values.end(), 0.0F);
    gpu::Texture texture({.kind = TextureKind::Volume, .format = Format::R32F, .width = 2, .height = 3, .depth = 4});
    texture.upload(values, {.layers = 4});
    texture.bind(0);
    const gpu::Program program = build_full_screen(R"(#version 450 core
layout(binding = 0) uniform sampler3D volume;
uniform vec3 coordinate;
layout(location = 0) out vec4 colour;
void main() { colour = texture(volume, coordinate); })");
    program.set("coordinate",
                glm::vec3(0.5F, 1.5F / 3.0F, 3.0F / 4.0F));  // between columns, on row 1, between slices 2 and 3
    const gpu::Framebuffer target({.width = 1, .height = 1, .colours = {Format::R32F}});
    gpu::FullScreenTriangle().draw(program, target);
    // Exact halves and whole texels are exact even with 8-bit weights.
    EXPECT_FLOAT_EQ(target.read_rgba_float()[0].r, 0.5F + 2.0F * 1.0F + 6.0F * 2.5F);
}

/// The direction through a point of a face, s and t from 0 to 1 as uploaded (OpenGL 4.5, table 8.19).
glm::vec3 face_direction(int face, float s, float t) {
    const float a = 2.0F * s - 1.0F;
    const float b = 2.0F * t - 1.0F;
    const std::array<glm::vec3, 6> directions{glm::vec3{1, -b, -a}, {-1, -b, a}, {a, 1, b},
                                              glm::vec3{a, -1, -b}, {a, -b, 1},  {-a, -b, -1}};
    return directions[static_cast<std::size_t>(face)];
}

TEST_F(TextureTest, CubeMapRowsRunDownwardsOnTheSides) {
    gpu::Texture texture({.kind = TextureKind::CubeMap, .format = Format::R32F, .width = 2, .height = 2},
                         {.filter = gpu::Filter::Nearest});
    for (int face = 0; face < 6; ++face) {
        const float base = 10.0F * static_cast<float>(face);
        texture.upload(std::vector<float>{base, base + 1, base + 2, base + 3}, {.layer = face});
    }
    texture.bind(0);
    const gpu::Program program = build_full_screen(R"(#version 450 core
layout(binding = 0) uniform samplerCube cube;
uniform vec3 direction;
layout(location = 0) out vec4 colour;
void main() { colour = texture(cube, direction); })");
    const gpu::Framebuffer target({.width = 1, .height = 1, .colours = {Format::R32F}});
    for (int face = 0; face < 6; ++face) {
        for (int texel = 0; texel < 4; ++texel) {
            const float s = texel % 2 == 0 ? 0.25F : 0.75F;
            const float t = texel / 2 == 0 ? 0.25F : 0.75F;
            program.set("direction", face_direction(face, s, t));
            gpu::FullScreenTriangle().draw(program, target);
            EXPECT_EQ(target.read_rgba_float()[0].r, static_cast<float>(10 * face + texel)) << face << " " << texel;
        }
    }
    // The first row of a side face is its upper one.
    program.set("direction", glm::vec3(1.0F, 0.5F, 0.5F));
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_LT(target.read_rgba_float()[0].r, 2.0F);
}

TEST_F(TextureTest, WrapRepeatsColumnsAndClampsRows) {
    gpu::Texture texture({.format = Format::R32F, .width = 2, .height = 2},
                         {.filter = gpu::Filter::Nearest, .wrap_s = gpu::Wrap::Repeat});
    texture.upload(std::vector<float>{1, 2, 3, 4});
    texture.bind(0);
    const gpu::Program program = build_full_screen(R"(#version 450 core
layout(binding = 0) uniform sampler2D image;
uniform vec2 coordinate;
layout(location = 0) out vec4 colour;
void main() { colour = texture(image, coordinate); })");
    const gpu::Framebuffer target({.width = 1, .height = 1, .colours = {Format::R32F}});
    program.set("coordinate", glm::vec2(1.25F, 1.25F));
    gpu::FullScreenTriangle().draw(program, target);
    EXPECT_EQ(target.read_rgba_float()[0].r, 3.0F);
}

TEST_F(TextureDeathTest, RefusesDataThatDoesNotFill) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto upload = [](std::size_t count, gpu::TextureSlice slice) {
        gpu::Texture texture({.format = Format::RGBA32F, .width = 2, .height = 2});
        texture.upload(std::vector<float>(count), slice);
    };
    EXPECT_DEATH(upload(15, {}), "15 values do not fill 4 texels");
    EXPECT_DEATH(upload(20, {}), "20 values do not fill 4 texels");
    EXPECT_DEATH(upload(16, {.level = 1}), "contract violated");
    EXPECT_DEATH(upload(16, {.layer = 1}), "contract violated");
}

}  // namespace

}  // namespace rowland
