#include "engine/render/renderer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"

#include "engine/scene/mesh_recipe.h"
#include "engine/view/picture.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/files.h"

namespace rowland::render {
namespace {

constexpr int kSize = 64;

lighting::LightProbe uniform_probe(const glm::vec3& radiance) {
    image::Image image{.width = 64, .height = 32, .texels = std::vector<glm::vec3>(std::size_t{64} * 32, radiance)};
    return lighting::build_light_probe(lighting::ProbeImage(std::move(image), lighting::Mapping::Equirectangular),
                                       {.prefilter = {.face_size = 16}});
}

class RendererTest : public test::GlTest {
 protected:
    /// A sphere that fills most of the frame, drawn with XYZ → working = identity.
    std::vector<glm::vec4> draw_sphere(const lighting::LightProbe& probe, const StandardMaterial& standard,
                                       const std::optional<diffraction::CookedMaterial>& grating = std::nullopt) {
        diffraction::register_module(renderer_);
        renderer_.set_probe(probe);
        const ecs::Entity entity = world_.create();
        world_.add(entity, scene::Transform{});
        world_.add(entity, make_mesh_instance(scene::build_mesh(scene::SphereRecipe{.radius = 1.0})));
        world_.add(entity, StandardMaterial(standard));
        if (grating) {
            const auto material = diffraction::make_gpu_material(*grating, glm::dmat3(1.0));
            world_.add(entity, material->base());
            world_.add(entity, diffraction::DiffractionSurface{material});
        }
        scene::update_world_matrices(world_);
        const gpu::Framebuffer target(
            {.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true});
        renderer_.render(world_, camera_, target);
        return target.read_rgba_float();
    }

    Renderer renderer_{glm::dmat3(1.0)};
    ecs::World world_;
    scene::Camera camera_{.eye = {0.0F, 0.0F, 3.0F}};
};

glm::vec3 centre(const std::vector<glm::vec4>& pixels) {
    return glm::vec3(pixels[static_cast<std::size_t>(kSize / 2 * kSize + kSize / 2)]);
}

// In a furnace of radiance 1 the framebuffer holds XYZ of D65 white where light comes back whole. The half floats of
// the environment and the fit of nine ambient terms bound it.
constexpr float kFurnaceTolerance = 5e-3F;

TEST_F(RendererTest, SkyShowsTheProbesRadiance) {
    const auto pixels = draw_sphere(uniform_probe(glm::vec3(1.0F)), {});
    EXPECT_NEAR(pixels[0].y, 1.0F, kFurnaceTolerance);
    EXPECT_NEAR(pixels[0].x, 0.9505F, kFurnaceTolerance);
    EXPECT_NEAR(pixels[0].z, 1.089F, kFurnaceTolerance);
}

TEST_F(RendererTest, MirrorSphereVanishesInAFurnace) {
    const auto pixels = draw_sphere(uniform_probe(glm::vec3(1.0F)),
                                    {.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.05F});
    EXPECT_NEAR(centre(pixels).y, 1.0F, kFurnaceTolerance);
    for (const glm::vec4& pixel : pixels) {
        EXPECT_LE(pixel.y, 1.0F + kFurnaceTolerance);
        EXPECT_GE(pixel.y, 0.93F);  // at the rim part of the lobe falls below the horizon and is lost
    }
}

/// E(n)/π of light with three bands, by brute force: the clamped cosine summed over directions of even density.
double irradiance_over_pi(const lighting::ShLight& light, const glm::dvec3& normal) {
    constexpr int kRows = 200;
    std::array<double, 9> basis;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 2 * kRows; ++column) {
            const double z = -1.0 + 2.0 * (row + 0.5) / kRows;
            const double azimuth = std::numbers::pi * (column + 0.5) / kRows;
            const double r = std::sqrt(1.0 - z * z);
            const glm::dvec3 s(r * std::cos(azimuth), r * std::sin(azimuth), z);
            math::evaluate_sh(s, 3, basis);
            double radiance = 0.0;
            for (std::size_t k = 0; k < 9; ++k) radiance += basis[k] * light.coefficients[k].y;
            sum += std::max(0.0, glm::dot(s, normal)) * radiance;
        }
    return sum * 4.0 / (2.0 * kRows * kRows);  // 4π / samples / π
}

/// Grey light of three bands that is positive everywhere, and black reflections.
lighting::LightProbe soft_light() {
    lighting::LightProbe probe;
    probe.sh.bands = 3;
    for (const double c : {3.0, 0.4, -0.3, 0.5, 0.2, -0.15, 0.1, 0.25, -0.2}) probe.sh.coefficients.emplace_back(c);
    probe.ambient = lighting::ambient_coefficients(probe.sh);
    probe.environment.layout = {.face_size = 4, .levels = 1};
    probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0);
    return probe;
}

TEST_F(RendererTest, DiffuseSphereReflectsItsAlbedoOfTheBruteForceIrradiance) {
    const lighting::LightProbe probe = soft_light();
    ASSERT_EQ(probe.ambient.window.window, math::SphericalWindow::None);
    constexpr float kAlbedo = 0.4F;

    const auto pixels = draw_sphere(probe, {.base_colour = glm::vec3(kAlbedo), .roughness = 1.0F});
    const double half_height = std::tan(0.5 * static_cast<double>(camera_.vertical_field_of_view));
    int compared = 0;
    for (int row = 4; row < kSize; row += 6)
        for (int column = 4; column < kSize; column += 6) {
            // The ray through the pixel's centre meets the unit sphere at eye + t d.
            const glm::dvec3 d = glm::normalize(glm::dvec3((2.0 * (column + 0.5) / kSize - 1.0) * half_height,
                                                           (1.0 - 2.0 * (row + 0.5) / kSize) * half_height, -1.0));
            const double b = 3.0 * d.z;
            const double discriminant = b * b - 8.0;
            if (discriminant < 0.5) continue;  // misses, or the rim where facets show
            const glm::dvec3 normal = glm::dvec3(0.0, 0.0, 3.0) + (-b - std::sqrt(discriminant)) * d;
            const double expected = static_cast<double>(kAlbedo) * irradiance_over_pi(probe.sh, normal);
            EXPECT_NEAR(pixels[static_cast<std::size_t>(row * kSize + column)].y, expected, 0.01 * expected);
            ++compared;
        }
    EXPECT_GT(compared, 30);
}

TEST_F(RendererTest, AGratingNeverReturnsMoreThanTheFurnaceSends) {
    const char* text = R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}, "orders": "all"},
                           "base": {"color": [1, 1, 1], "roughness": 1}})";
    const auto pixels =
        draw_sphere(uniform_probe(glm::vec3(1.0F)), {}, diffraction::cook_material(parse_json(text, "test"), "test"));
    float largest = 0.0F;
    for (const glm::vec4& pixel : pixels) largest = std::max(largest, pixel.y);
    EXPECT_LT(largest, 1.0F + 0.04F + kFurnaceTolerance);  // 0.04: the base's Fresnel layer lies over its diffuse part
    // Slit: 1/4 mirror + 1/4 in the orders + 1/2 base, of which some orders are evanescent.
    EXPECT_GT(centre(pixels).y, 0.6F);
}

/// What an object keeps of its light is a renderer's own: each counts the changes of its light from 1.
TEST_F(RendererTest, TwoOverOneWorldShowEachItsOwnProbe) {
    std::array<std::optional<Renderer>, 2> renderers;
    for (std::size_t i = 0; i < 2; ++i) {
        diffraction::register_module(renderers[i].emplace(glm::dmat3(1.0)));
        renderers[i]->set_probe(uniform_probe(glm::vec3(1.0F + 3.0F * static_cast<float>(i))));
    }
    const gpu::Framebuffer target({.width = 8, .height = 8, .colours = {gpu::Format::RGBA32F}, .depth = true});
    for (const char* representation : {R"("arc")", R"("spikes")", R"("planar", "map_resolution": 16)"}) {
        const std::string material = std::string(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit",
            "width_nm": 800}}, "quality": {"representation": )") +
                                     representation + "}}";
        ecs::World world;
        const ecs::Entity entity = world.create();
        world.add(entity, scene::Transform{});
        world.add(entity, make_mesh_instance(
                              scene::build_mesh(scene::DiscRecipe{.outer_radius = 1.0, .rings = 2, .segments = 9})));
        world.add(entity, StandardMaterial{});
        diffraction::add_surface(
            world, entity,
            {.material = diffraction::make_gpu_material(
                 diffraction::cook_material(parse_json(material, "test"), "test"), glm::dmat3(1.0))},
            true);
        scene::update_world_matrices(world);
        const auto brightness = [&](Renderer& renderer) {
            renderer.render(world, {.eye = {0.0F, 2.0F, 1.0F}}, target);
            return target.read_rgba_float()[35].y;
        };
        const float bright = brightness(*renderers[1]);
        EXPECT_NEAR(bright, 1.6F, 1.0F);  // the sky has 4
        for (int frame = 0; frame < 2; ++frame) {
            EXPECT_NEAR(brightness(*renderers[0]), 0.25F * bright, 1e-3F * bright) << representation;
            EXPECT_NEAR(brightness(*renderers[1]), bright, 1e-3F * bright) << representation;
        }
    }
}

TEST_F(RendererTest, ReloadedShadersAreUsedAndABrokenOneKeepsTheOld) {
    renderer_.set_probe(uniform_probe(glm::vec3(1.0F)));
    const gpu::Framebuffer target({.width = 4, .height = 4, .colours = {gpu::Format::RGBA32F}, .depth = true});
    const auto draw = [&] {
        renderer_.render(world_, {}, target);
        return target.read_rgba_float()[0];
    };
    EXPECT_NEAR(draw().y, 1.0F, kFurnaceTolerance);

    const test::TemporaryFolder tree;
    const std::filesystem::path sky = tree.path() / "engine/render/shaders/sky.frag.glsl";
    const std::string head = "#version 450 core\nin vec3 direction;\nlayout(location = 0) out vec4 radiance;\n";
    write_file_atomic(sky, head + "void main() { radiance = vec4(7.0, 8.0, 9.0, 1.0); }\n");
    renderer_.reload_shaders(tree.path());
    EXPECT_EQ(draw(), glm::vec4(7.0F, 8.0F, 9.0F, 1.0F));

    write_file_atomic(sky, head + "void main() { radiance = nonsense; }\n");
    try {
        renderer_.reload_shaders(tree.path());
        FAIL() << "a broken shader compiled";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("sky.frag.glsl"), testing::HasSubstr("nonsense")));
    }
    EXPECT_EQ(draw(), glm::vec4(7.0F, 8.0F, 9.0F, 1.0F));
}

/// A probe 16 times as bright is not shown white, nor adapted to in seconds.
TEST_F(RendererTest, ANewProbeIsACutForAutomaticExposure) {
    view::Picture picture(post::OcioConfig::choose(std::nullopt), "", {4, 4});
    picture.post_settings().auto_exposure = post::AutoExposureSettings{};
    const auto stops = [&](float radiance) {
        picture.set_probe(uniform_probe(glm::vec3(radiance)));
        picture.draw(world_, {}, 0.001F);
        return picture.exposure_stops();
    };
    const float first = stops(1.0F);
    EXPECT_NEAR(stops(16.0F), first - 4.0F, 0.01F);
}

TEST(BrdfTable, WhiteMirrorKeepsAllLight) {
    const int size = 16;
    const auto table = bake_brdf_table(size);
    // Smooth rows: scale + bias = 1 (no shadowing). Rough rows lose what scatters twice, never gain.
    for (int column = 2; column < size; ++column)
        EXPECT_NEAR(table[static_cast<std::size_t>(column)].x + table[static_cast<std::size_t>(column)].y, 1.0F, 0.01F);
    for (const glm::vec2& entry : table) {
        EXPECT_LE(entry.x + entry.y, 1.005F);
        EXPECT_GE(entry.x, 0.0F);
        EXPECT_GE(entry.y, 0.0F);
    }
}

}  // namespace
}  // namespace rowland::render
