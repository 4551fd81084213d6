#include "engine/post/display_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "engine/core/file.h"
#include "tests/gpu/engine/post/post_test.h"
#include "tests/support/files.h"

namespace rowland {

namespace {

using post::DisplayPass;
using post::DisplaySelection;
using post::DisplayTransform;
using post::OcioConfig;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// The rule for "the same on both": difference over max(1, display value), the latter because un-tone-mapped and raw
/// views are unbounded (65504 comes out as about 1e2 or as itself) and floats are relative. OpenColorIO evaluates log,
/// exp and pow by approximations on the CPU, good to 1e-5, which gamma curves near black magnify.
constexpr double gpu_tolerance = 1e-4;

/// Neutrals, single channels and mixtures of both signs from 1e-8 to 65504, the largest half float; 0; 256 random
/// colours, some with negative components.
std::vector<glm::vec3> finite_pixels() {
    std::vector<glm::vec3> pixels{glm::vec3(0.0F), glm::vec3(0.18F), glm::vec3(1.0F), glm::vec3(65504.0F)};
    for (double exponent = -8.0; exponent <= 4.8; exponent += 0.1) {
        const auto value = static_cast<float>(std::pow(10.0, exponent));
        pixels.insert(pixels.end(),
                      {glm::vec3(value), glm::vec3(-value), glm::vec3(value, 0, 0), glm::vec3(0, value, 0),
                       glm::vec3(0, 0, value), glm::vec3(value, -0.1F * value, 0.5F * value)});
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-3.0F, 2.0F);
    std::uniform_real_distribution<float> offset(0.0F, 0.3F);
    const auto component = [&] { return std::pow(10.0F, exponent(random)) - offset(random); };
    for (int i = 0; i < 256; ++i) {
        glm::vec3 colour(0.0F);
        for (int c = 0; c < 3; ++c) colour[c] = component();
        pixels.push_back(colour);
    }
    return pixels;
}

std::vector<glm::vec3> non_finite_pixels() {
    return {glm::vec3(not_a_number), {not_a_number, 0.5F, 0.25F}, glm::vec3(infinity),    {infinity, 0.5F, 0.25F},
            glm::vec3(-infinity),    {-infinity, 0.5F, 0.25F},    {0.5F, 0.25F, infinity}};
}

double worst_difference(const std::vector<glm::vec4>& drawn, const std::vector<glm::vec3>& expected) {
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double scale = std::max(1.0, std::abs(static_cast<double>(expected[i][c])));
            const double difference = std::abs(static_cast<double>(drawn[i][c]) - expected[i][c]) / scale;
            if (!(difference <= worst)) worst = difference;  // so that NaN is the worst of all
        }
    }
    return worst;
}

class DisplayPassTest : public test::PostTest {
 protected:
    /// Display values of scene-linear pixels, by way of float textures.
    static std::vector<glm::vec4> draw(const DisplayPass& pass, std::span<const glm::vec3> pixels, float stops) {
        const int width = static_cast<int>(pixels.size());
        gpu::Texture source({.format = gpu::Format::RGBA32F, .width = width});
        source.upload(pixels);
        const gpu::Framebuffer drawn = target({width, 1});
        pass.draw(source, stops, drawn);
        return drawn.read_rgba_float();
    }

    static GLint current_program() {
        GLint program = 0;
        glGetIntegerv(GL_CURRENT_PROGRAM, &program);
        return program;
    }

    /// The largest difference between GPU and CPU over `pixels` at two exposures.
    double gpu_against_cpu(const DisplayTransform& transform, const std::vector<glm::vec3>& pixels) {
        const DisplayPass pass(library_, transform);
        double worst = 0.0;
        for (const float stops : {0.0F, 1.5F}) {
            std::vector<glm::vec3> expected = pixels;
            transform.apply_cpu(expected, stops);
            const double difference = worst_difference(draw(pass, pixels, stops), expected);
            if (!(difference <= worst)) worst = difference;
        }
        return worst;
    }

    void expect_gpu_as_cpu(const OcioConfig& config, const DisplaySelection& selection) {
        const DisplayTransform transform(config, selection);
        const double finite = gpu_against_cpu(transform, finite_pixels());
        const double non_finite = gpu_against_cpu(transform, non_finite_pixels());
        // Colours of neighbouring stops differ by .9 from node to node of a table, and texture units may have positions
        // of 8 bits between them, cut off.
        const double tolerance = selection.view == "False Colour" ? 0.9 / 256.0 : gpu_tolerance;
        EXPECT_LE(finite, tolerance) << selection.display << " / " << selection.view;
        EXPECT_LE(non_finite, tolerance) << selection.display << " / " << selection.view;
    }
};

TEST_F(DisplayPassTest, ShippedConfigurationIsTheSameOnGpuAndCpu) {
    const OcioConfig config = OcioConfig::shipped();
    for (const std::string& display : config.displays())
        for (const std::string& view : config.views(display)) expect_gpu_as_cpu(config, {display, view});
}

TEST_F(DisplayPassTest, AnApplicationsDecimalCommaChangesNothing) {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
    expect_gpu_as_cpu(OcioConfig::shipped(), {"sRGB - Display", "ACES 1.0 - SDR Video"});
    EXPECT_EQ(std::use_facet<std::numpunct<char>>(std::locale()).decimal_point(), ',') << "the application's";
    std::locale::global(before);
}

TEST_F(DisplayPassTest, AcesCgConfigurationIsTheSameOnGpuAndCpu) {
    ROWLAND_TEST_DATA(path, "ocio/aces_configs/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio");
    const OcioConfig config = OcioConfig::from_file(path);
    expect_gpu_as_cpu(config, {"sRGB - Display", "ACES 1.0 - SDR Video"});
    expect_gpu_as_cpu(config, {"Rec.2100-PQ - Display", "Un-tone-mapped"});  // its curve is a table in a texture
}

TEST_F(DisplayPassTest, AcesStudioConfigurationIsTheSameOnGpuAndCpu) {
    ROWLAND_TEST_DATA(path, "ocio/aces_configs/studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio");
    const OcioConfig config = OcioConfig::from_file(path);
    expect_gpu_as_cpu(config, {"sRGB - Display", "ACES 1.0 - SDR Video (D60 sim on D65)"});
    expect_gpu_as_cpu(config, {"P3-D65 - Display", "ACES 1.0 - SDR Cinema"});
}

TEST_F(DisplayPassTest, ExposureChangesThePictureButNotTheProgram) {
    const DisplayPass pass(library_, DisplayTransform(OcioConfig::shipped()));
    const std::vector<glm::vec3> grey{glm::vec3(0.18F)};
    const float normal = draw(pass, grey, 0.0F)[0].g;
    const GLint program = current_program();
    const float brighter = draw(pass, grey, 1.0F)[0].g;
    EXPECT_EQ(current_program(), program);
    EXPECT_GT(brighter, normal + 0.1F);
    EXPECT_LT(draw(pass, grey, -1.0F)[0].g, normal - 0.1F);
    EXPECT_EQ(draw(pass, grey, 0.0F)[0].g, normal);
    // Exposure is a factor on scene-linear light, to the rounding of one product.
    const std::vector<glm::vec3> twice{glm::vec3(0.36F)};
    EXPECT_NEAR(brighter, draw(pass, twice, 0.0F)[0].g, 1e-6F);
}

TEST_F(DisplayPassTest, ProgramIsBuiltAnewOnlyForAnotherTransform) {
    const OcioConfig config = OcioConfig::shipped();
    const std::vector<glm::vec3> grey{glm::vec3(0.18F)};
    DisplayPass pass(library_, DisplayTransform(config));
    const float normal = draw(pass, grey, 0.0F)[0].g;
    const GLint program = current_program();
    pass.set_transform(library_, DisplayTransform(config));
    // Exposure still reaches the program after a transform that is equal but another object.
    EXPECT_GT(draw(pass, grey, 1.0F)[0].g, normal + 0.1F);
    EXPECT_EQ(current_program(), program);

    pass.set_transform(library_, DisplayTransform(config, {"", "Raw"}));
    EXPECT_EQ(draw(pass, grey, 0.0F)[0].g, 0.18F);
}

TEST_F(DisplayPassTest, DrawsIntoEightBitsAndKeepsAlpha) {
    const DisplayPass pass(library_, DisplayTransform(OcioConfig::shipped(), {"", "Raw"}));
    gpu::Texture source({.format = gpu::Format::RGBA16F, .width = 2, .height = 2});
    source.upload(std::vector<float>{1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.2F, -1, 2, 0.4F, 1});
    const gpu::Framebuffer target({.width = 2, .height = 2, .colours = {gpu::Format::RGBA8}});
    pass.draw(source, 0.0F, target);
    EXPECT_EQ(target.read_rgba8(),
              (std::vector<std::uint8_t>{0, 0, 255, 51, 0, 255, 102, 255, 255, 0, 0, 255, 0, 255, 0, 255}));
}

/// A configuration with one display and two views, both through a 1D table and a 3D table that treats its axes
/// differently, one interpolated linearly and one by tetrahedra.
OcioConfig table_config(const std::filesystem::path& folder) {
    std::string cube = "LUT_3D_SIZE 4\n";
    for (int b = 0; b < 4; ++b) {
        for (int g = 0; g < 4; ++g) {
            for (int r = 0; r < 4; ++r) {
                cube +=
                    fmt::format("{} {} {}\n", 0.1 * r * g / 3.0, 0.3 * g + 0.02 * b * b, (3.0 - b) * (r + 1) / 12.0);
            }
        }
    }
    write_file_atomic(folder / "table.cube", cube);
    write_file_atomic(folder / "curve.spi1d",
                      "Version 1\nFrom 0.0 1.0\nLength 5\nComponents 1\n{\n0.0\n0.1\n0.5\n0.7\n1.0\n}\n");
    write_file_atomic(folder / "tables.ocio", R"(ocio_profile_version: 2
search_path: .
roles: {scene_linear: linear, default: linear}
file_rules: [!<Rule> {name: Default, colorspace: default}]
displays:
  screen:
    - !<View> {name: linear, colorspace: linearly}
    - !<View> {name: tetrahedral, colorspace: by tetrahedra}
colorspaces:
  - !<ColorSpace>
    name: linear
  - !<ColorSpace>
    name: linearly
    from_scene_reference: !<GroupTransform>
      children:
        - !<FileTransform> {src: curve.spi1d, interpolation: linear}
        - !<FileTransform> {src: table.cube, interpolation: linear}
  - !<ColorSpace>
    name: by tetrahedra
    from_scene_reference: !<GroupTransform>
      children:
        - !<FileTransform> {src: curve.spi1d, interpolation: linear}
        - !<FileTransform> {src: table.cube, interpolation: tetrahedral}
)");
    return OcioConfig::from_file(folder / "tables.ocio");
}

TEST_F(DisplayPassTest, TablesReachTheGpuWithTheirAxesInOrder) {
    const test::TemporaryFolder folder;
    const OcioConfig config = table_config(folder.path());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<glm::vec3> pixels{glm::vec3(0.0F), glm::vec3(1.0F), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 200; ++i) {
        const float r = uniform(random);
        const float g = uniform(random);
        pixels.emplace_back(r, g, uniform(random));
    }
    for (const char* view : {"linear", "tetrahedral"}) {
        const DisplayTransform transform(config, {"screen", view});
        const DisplayPass pass(library_, transform);
        std::vector<glm::vec3> expected = pixels;
        transform.apply_cpu(expected);
        // GPUs keep 8 bits of a filter weight: half a step off, in one direction for the curve (its steps are below
        // 0.4, and a step of the cube is up to 3 × 0.34 per axis unit) and in three for the cube (steps below 0.34).
        const double weight_error = 0.5 / 256.0;
        const double tolerance = weight_error * (0.4 * 3.0 * 0.34 * 3.0 + 3.0 * 0.34);
        EXPECT_LE(worst_difference(draw(pass, pixels, 0.0F), expected), tolerance) << view;
    }
}

TEST_F(DisplayPassTest, AnotherTableIsAnotherTransform) {
    const test::TemporaryFolder folder;
    const OcioConfig config = table_config(folder.path());
    DisplayPass pass(library_, DisplayTransform(config, {"screen", "tetrahedral"}));
    const std::vector<glm::vec3> pixels{{0.3F, 0.9F, 0.6F}};
    const glm::vec4 before = draw(pass, pixels, 0.0F)[0];

    const test::TemporaryFolder other_folder;
    (void)table_config(other_folder.path());
    write_file_atomic(other_folder.path() / "curve.spi1d",
                      "Version 1\nFrom 0.0 1.0\nLength 5\nComponents 1\n{\n1.0\n0.7\n0.5\n0.1\n0.0\n}\n");
    const OcioConfig other = OcioConfig::from_file(other_folder.path() / "tables.ocio");
    pass.set_transform(library_, DisplayTransform(other, {"screen", "tetrahedral"}));
    EXPECT_NE(draw(pass, pixels, 0.0F)[0], before);
}

}  // namespace

}  // namespace rowland
