// What a surface's maps, colours and modes do, pixel by pixel.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/render/surface_textures.h"
#include "tests/gpu/render_test.h"
#include "tests/gpu/wide_halves.h"

namespace rowland::render {
namespace {

using scene::AlphaMode;
using SurfaceTest = test::RenderTest;

// 32-bit floats throughout, a dozen operations.
constexpr float kSurfaceRounding = 1e-5F;

const glm::vec4 kRed(1.0F, 0.0F, 0.0F, 1.0F);
const glm::vec4 kGreen(0.0F, 1.0F, 0.0F, 1.0F);
const glm::vec4 kBlue(0.0F, 0.0F, 1.0F, 1.0F);
const glm::vec4 kWhite(1.0F);

void expect_near(const glm::vec4& drawn, const glm::vec3& expected, float tolerance = kSurfaceRounding) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawn[c], expected[c], tolerance) << "channel " << c;
}

/// An unlit surface that shows four texels: red and green above, blue and white below.
StandardMaterial four_colours(const SurfaceTexture& texture) {
    return {.base_colour = glm::vec3(1.0F), .base_colour_texture = texture, .unlit = true};
}

TEST_F(SurfaceTest, BaseColourTexelsShowWhereTheirUvIs) {
    add(square(), four_colours(texture(2, {kRed, kGreen, kBlue, kWhite})));
    const auto pixels = draw();
    expect_near(at(pixels, -0.5F, 0.5F), kRed);
    expect_near(at(pixels, 0.5F, 0.5F), kGreen);
    expect_near(at(pixels, -0.5F, -0.5F), kBlue);
    expect_near(at(pixels, 0.5F, -0.5F), kWhite);
    expect_near(at(pixels, 1.1F, 0.0F), glm::vec3(0.0F));  // beside the square: the black sky
}

TEST_F(SurfaceTest, BaseColourFactorMultipliesTheTexelInRec709) {
    // In another working space the product taken there would differ.
    Renderer renderer(colour::xyz_to_acescg());
    renderer.set_probe(even_light(0.0F));
    StandardMaterial material = four_colours(texture(1, {{0.5F, 0.25F, 1.0F, 1.0F}}));
    material.base_colour = {0.8F, 0.4F, 0.2F};
    add(square(), material);
    renderer.render(world_, camera_, target_);
    const glm::dvec3 product(0.8 * 0.5, 0.4 * 0.25, 0.2);
    const glm::dmat3 to_working = colour::xyz_to_acescg() * colour::rec709_to_xyz();
    expect_near(at(target_.read_rgba_float(), 0.0F, 0.0F), glm::vec3(to_working * product));
}

TEST_F(SurfaceTest, UvTransformTurnsAsTheExtensionSays) {
    // KHR_texture_transform's own example: a quarter turn, scale ½ and offset (0, 1) take the lower left quadrant.
    SurfaceTexture map = texture(2, {kRed, kGreen, kBlue, kWhite});
    map.transform = {.offset = {0.0F, 1.0F}, .rotation = 1.57079632679F, .scale = {0.49F, 0.49F}};
    const ecs::Entity entity = add(square(), four_colours(map));
    for (const glm::vec2 position : {glm::vec2(-0.8F, 0.8F), glm::vec2(0.8F, 0.8F), glm::vec2(0.8F, -0.8F)})
        expect_near(at(draw(), position.x, position.y), kBlue);
    // The full picture, turned clockwise: u' = v, v' = 1 − u.
    world_.get<StandardMaterial>(entity).base_colour_texture.transform.scale = {1.0F, 1.0F};
    const auto pixels = draw();
    expect_near(at(pixels, -0.5F, 0.5F), kBlue);
    expect_near(at(pixels, 0.5F, 0.5F), kRed);
    expect_near(at(pixels, 0.5F, -0.5F), kGreen);
    expect_near(at(pixels, -0.5F, -0.5F), kWhite);
}

TEST_F(SurfaceTest, UvTransformScalesBeforeItTurnsAndMovesLast) {
    std::vector<glm::vec4> texels;
    for (int i = 0; i < 16; ++i) texels.emplace_back(static_cast<float>(i), 0.0F, 0.0F, 1.0F);
    SurfaceTexture map = texture(4, texels);
    map.transform = {.offset = {0.125F, 0.5F}, .rotation = 0.5F, .scale = {2.0F, 0.75F}};
    add(square(), four_colours(map));
    const auto pixels = draw();
    int compared = 0;
    for (const float x : {-0.7F, -0.3F, 0.15F, 0.6F})
        for (const float y : {-0.65F, 0.1F, 0.35F, 0.8F}) {
            const glm::vec3 position = position_of(x, y);
            const glm::vec2 uv(2.0F * (0.5F + 0.5F * position.x), 0.75F * (0.5F - 0.5F * position.y));
            const glm::vec2 turned(std::cos(0.5F) * uv.x + std::sin(0.5F) * uv.y,
                                   -std::sin(0.5F) * uv.x + std::cos(0.5F) * uv.y);
            const glm::vec2 texel = 4.0F * glm::fract(turned + glm::vec2(0.125F, 0.5F));
            const glm::vec2 within = glm::abs(glm::fract(texel) - 0.5F);
            if (std::max(within.x, within.y) > 0.48F) continue;  // on the border of two
            const float expected = 4.0F * std::floor(texel.y) + std::floor(texel.x);
            EXPECT_EQ(at(pixels, x, y).r, expected) << x << " " << y;
            ++compared;
        }
    EXPECT_GT(compared, 10);
}

TEST_F(SurfaceTest, SecondUvSetIsUsedWhereTheMapAsksForIt) {
    scene::Mesh mesh = square();
    for (const glm::vec2& uv : mesh.uvs) mesh.uvs1.emplace_back(1.0F - uv.x, uv.y);
    SurfaceTexture map = texture(2, {kRed, kGreen});
    map.uv_set = 1;
    add(mesh, four_colours(map));
    expect_near(at(draw(), -0.5F, 0.0F), kGreen);
    expect_near(at(draw(), 0.5F, 0.0F), kRed);
}

TEST_F(SurfaceTest, VertexColoursMultiplyTheBaseColour) {
    scene::Mesh mesh = square();
    mesh.colours = {
        {0.0F, 0.5F, 1.0F, 1.0F}, {1.0F, 0.5F, 1.0F, 1.0F}, {1.0F, 0.5F, 1.0F, 1.0F}, {0.0F, 0.5F, 1.0F, 1.0F}};
    add(mesh, {.base_colour = {0.5F, 0.5F, 0.25F}, .unlit = true});
    const float across = 0.5F + 0.5F * position_of(0.4F, 0.0F).x;
    expect_near(at(draw(), 0.4F, 0.0F), {0.5F * across, 0.25F, 0.25F});
}

TEST_F(SurfaceTest, EmissionAddsFactorTimesMap) {
    const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F),
                                              .metallic = 1.0F,
                                              .emissive = {0.5F, 2.0F, 4.0F},
                                              .emissive_texture = texture(1, {{1.0F, 0.5F, 0.25F, 1.0F}})});
    expect_near(at(draw(), 0.0F, 0.0F), {0.5F, 1.0F, 1.0F});
    world_.get<StandardMaterial>(entity).emissive_texture = {};
    expect_near(at(draw(), 0.0F, 0.0F), {0.5F, 2.0F, 4.0F});
}

TEST_F(SurfaceTest, UnlitSurfacesShowBaseColourInAnyLight) {
    renderer_.set_probe(even_light(1.0F));
    world_.add(world_.create(),
               scene::DirectionalLight{.direction = {0.0F, 0.0F, 1.0F}, .irradiance = glm::vec3(9.0F)});
    add(square(), {.base_colour = {0.1F, 0.2F, 0.3F}, .unlit = true});
    expect_near(at(draw(), 0.0F, 0.0F), {0.1F, 0.2F, 0.3F});
}

TEST_F(SurfaceTest, UnlitShadingShowsTexturesToo) {
    StandardMaterial material = four_colours(texture(2, {kRed, kGreen, kBlue, kWhite}));
    material.unlit = false;
    add(square(), material);
    expect_near(at(draw(Shading::Unlit), -0.5F, 0.5F), kRed);
}

/// Radiance of the square's pixel that at(pixels, x, y) is, of a light of irradiance π from `toward`.
glm::vec3 lit(const glm::vec3& position, const glm::vec3& toward, const glm::vec3& normal, double metallic,
              double roughness) {
    const glm::dvec3 v = glm::normalize(glm::dvec3(0.0, 0.0, 3.0) - glm::dvec3(position));
    return glm::vec3(3.14159265358979 * test::reflected(glm::normalize(glm::dvec3(toward)),
                                                        glm::normalize(glm::dvec3(normal)), v, glm::dvec3(0.5),
                                                        metallic, roughness));
}

class LitSurfaceTest : public SurfaceTest {
 protected:
    LitSurfaceTest() {
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(kToward),
                                                            .irradiance = glm::vec3(3.14159265358979F)});
    }
    static constexpr glm::vec3 kToward{0.5F, 0.3F, 0.8F};
    static constexpr float kTolerance = 2e-5F;  // GGX's peak amplifies rounding a little
};

TEST_F(LitSurfaceTest, MetallicAndRoughnessComeFromBlueAndGreen) {
    add(square(), {.base_colour = glm::vec3(0.5F),
                   .metallic = 0.8F,
                   .roughness = 0.9F,
                   .metallic_roughness_texture = texture(1, {{0.0F, 0.5F, 0.25F, 1.0F}})});
    const glm::vec3 position = position_of(0.2F, -0.3F);
    expect_near(at(draw(), 0.2F, -0.3F), lit(position, kToward, {0.0F, 0.0F, 1.0F}, 0.8 * 0.25, 0.9 * 0.5), kTolerance);
}

TEST_F(LitSurfaceTest, NormalMapTiltsTheShadingNormalInTheTangentFrame) {
    // The texel's normal is (0.6, 0.2, 0.77); x along the tangent, y up in the picture, both times the scale.
    const glm::vec3 normal(0.6F, 0.2F, 0.77F);
    const StandardMaterial material{.base_colour = glm::vec3(0.5F),
                                    .roughness = 0.6F,
                                    .normal_texture = texture(1, {glm::vec4(0.5F * normal + 0.5F, 0.0F)}),
                                    .normal_scale = 0.5F};
    const ecs::Entity entity = add(square(), material);
    const glm::vec3 position = position_of(-0.3F, 0.4F);
    expect_near(at(draw(), -0.3F, 0.4F), lit(position, kToward, {0.3F, 0.1F, 0.77F}, 0.0, 0.6), kTolerance);

    // The other handedness turns y over.
    scene::Mesh mesh = square();
    for (glm::vec4& tangent : mesh.tangents) tangent.w = -1.0F;
    world_.add(entity, make_mesh_instance(mesh));
    expect_near(at(draw(), -0.3F, 0.4F), lit(position, kToward, {0.3F, -0.1F, 0.77F}, 0.0, 0.6), kTolerance);

    // Mirrored in x: the tangent points along −x, the picture's up stays up.
    world_.add(entity, make_mesh_instance(square()));
    world_.get<scene::WorldMatrix>(entity).matrix = glm::scale(glm::mat4(1.0F), {-1.0F, 1.0F, 1.0F});
    expect_near(at(draw(), -0.3F, 0.4F), lit(position, kToward, {-0.3F, 0.1F, 0.77F}, 0.0, 0.6), kTolerance);
}

/// Relative RMS difference of a white metal's pixels from means over 256 samples. `normal`: of sample i at a position.
template <typename Normal>
double difference_from_mean(const std::vector<glm::vec4>& pixels, int side, float pixel, const glm::vec3& toward,
                            double roughness, const Normal& normal) {
    double off = 0.0;
    double whole = 0.0;
    for (int row = 5; row < side - 5; ++row)
        for (int column = 5; column < side - 5; ++column) {
            double wanted = 0.0;
            for (int i = 0; i < 256; ++i) {
                const glm::vec2 within = (glm::vec2(i % 16, i / 16) - 7.5F) / 16.0F;
                const glm::vec2 at = glm::vec2(column, -row) + 0.5F * glm::vec2(1 - side, side - 1) + within;
                const glm::vec3 position(pixel * at, 0.0F);
                wanted += lit(position, toward, normal(position), 1.0, roughness).g / 256.0;
            }
            const double drawn = pixels[static_cast<std::size_t>(row * side + column)].g;
            off += (drawn - wanted) * (drawn - wanted);
            whole += wanted * wanted;
        }
    return std::sqrt(off / whole);
}

TEST_F(LitSurfaceTest, NormalsThatVaryWithinAPixelWidenTheHighlight) {
    // A map of 19 x 19 texels per pixel, whose slopes are normally distributed.
    constexpr int kTexels = 512;
    std::mt19937 random(5);
    std::normal_distribution<float> slope(0.0F, 0.2F);
    const auto normal = [&] {
        const float y = slope(random);
        return glm::normalize(glm::vec3(slope(random), y, 1.0F));
    };
    auto picture = std::make_shared<image::ByteImage>(image::ByteImage{kTexels, kTexels, {}});
    for (int i = 0; i < kTexels * kTexels; ++i) {
        const glm::u8vec4 texel(glm::round(127.5F * (normal() + 1.0F)), 255);
        picture->rgba.insert(picture->rgba.end(), {texel.r, texel.g, texel.b, texel.a});
    }
    scene::ImportedScene scene;
    scene.images = {picture};
    scene.textures = {{.image = 0}};
    SurfaceTextures textures(scene);
    add(square(), {.base_colour = glm::vec3(0.5F),
                   .metallic = 1.0F,
                   .roughness = 0.25F,
                   .normal_texture = textures.get({}, TexelMeaning::Normal)});
    // An unchanged lobe is 81 % off. GGX in place of the mean of lobes: 30 %.
    const float pixel = 2.0F * kHalfView / kSize;
    EXPECT_LT(difference_from_mean(draw(), kSize, pixel, kToward, 0.25, [&](const glm::vec3&) { return normal(); }),
              0.35);
}

TEST_F(LitSurfaceTest, ACurvedSurfacesHighlightIsAsWideAsAPixelsNormals) {
    const auto normal = [](const glm::vec3& position) {
        return glm::normalize(position + glm::vec3(0.0F, 0.0F, 1.0F));
    };
    scene::Mesh mesh = square();
    std::ranges::transform(mesh.positions, mesh.normals.begin(), normal);
    add(mesh, {.base_colour = glm::vec3(0.5F),
               .metallic = 1.0F,
               .roughness = 0.08F,
               .normal_texture = texture(1, {glm::vec4(0.5F, 0.5F, 1.0F, 0.0F)})});
    // An unchanged lobe is 59 % off.
    EXPECT_LT(difference_from_mean(draw(), kSize, 2.0F * kHalfView / kSize, kToward, 0.08, normal), 0.25);
}

TEST_F(LitSurfaceTest, TheBackOfADoubleSidedSurfaceIsLitAsAFront) {
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0F), 3.14159265F, {0.0F, 1.0F, 0.0F});
    const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.5F), .roughness = 0.7F}, turned);
    expect_near(at(draw(), 0.1F, 0.2F), glm::vec3(0.0F));  // single-sided: its back does not show
    world_.get<StandardMaterial>(entity).double_sided = true;
    expect_near(at(draw(), 0.1F, 0.2F), lit(position_of(0.1F, 0.2F), kToward, {0.0F, 0.0F, 1.0F}, 0.0, 0.7),
                kTolerance);
    // Both mirrored and turned, the back is still the back.
    world_.get<scene::WorldMatrix>(entity).matrix = glm::scale(turned, {-1.0F, 1.0F, 1.0F});
    expect_near(at(draw(), 0.1F, 0.2F), lit(position_of(0.1F, 0.2F), kToward, {0.0F, 0.0F, 1.0F}, 0.0, 0.7),
                kTolerance);
}

TEST_F(LitSurfaceTest, OcclusionDarkensWhatComesFromAroundAndNothingElse) {
    const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.5F),
                                              .roughness = 0.8F,
                                              .occlusion_texture = texture(1, {{0.25F, 1.0F, 1.0F, 1.0F}})});
    const auto centre = [&](float around, float occlusion_strength) {
        renderer_.set_probe(even_light(around));
        world_.get<StandardMaterial>(entity).occlusion_strength = occlusion_strength;
        return at(draw(), 0.0F, 0.0F).g;
    };
    const float direct = centre(0.0F, 1.0F);
    EXPECT_NEAR(direct, lit({}, kToward, {0.0F, 0.0F, 1.0F}, 0.0, 0.8).g, kTolerance);
    const float open = centre(1.0F, 0.0F) - direct;
    EXPECT_GT(open, 0.4F);
    EXPECT_NEAR(centre(1.0F, 1.0F) - direct, 0.25F * open, kSurfaceRounding);
    EXPECT_NEAR(centre(1.0F, 0.5F) - direct, (1.0F - 0.5F * 0.75F) * open, kSurfaceRounding);
}

TEST_F(SurfaceTest, MaskDiscardsBelowTheCutoffAndKeepsFromItOn) {
    const SurfaceTexture map = texture(
        4, {{1.0F, 1.0F, 1.0F, 0.0F}, {1.0F, 1.0F, 1.0F, 0.59F}, {1.0F, 1.0F, 1.0F, 0.61F}, {1.0F, 1.0F, 1.0F, 1.0F}});
    StandardMaterial material = four_colours(map);
    material.alpha = 0.5F;
    material.alpha_cutoff = 0.3F;
    material.alpha_mode = AlphaMode::Mask;
    const ecs::Entity entity = add(square(), material);
    const auto pixels = draw();
    expect_near(at(pixels, -0.75F, 0.0F), glm::vec3(0.0F));
    expect_near(at(pixels, -0.25F, 0.0F), glm::vec3(0.0F));
    expect_near(at(pixels, 0.25F, 0.0F), glm::vec3(1.0F));
    EXPECT_EQ(at(pixels, 0.25F, 0.0F).a, 1.0F);
    expect_near(at(pixels, 0.75F, 0.0F), glm::vec3(1.0F));
    // Opaque surfaces have no alpha.
    world_.get<StandardMaterial>(entity).alpha_mode = AlphaMode::Opaque;
    expect_near(at(draw(), -0.75F, 0.0F), glm::vec3(1.0F));
}

TEST_F(SurfaceTest, BlendedSurfacesCoverWhatIsBehindThemInOrder) {
    renderer_.set_probe(even_light(1.0F));  // the sky: radiance 1
    const glm::vec3 red(0.9F, 0.1F, 0.0F);
    const glm::vec3 blue(0.0F, 0.2F, 0.8F);
    const auto glass = [&](const glm::vec3& colour, float alpha, float z) {
        add(square(), {.base_colour = colour, .alpha = alpha, .alpha_mode = AlphaMode::Blend, .unlit = true},
            glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, z}));
    };
    // Whatever the order they were made in, the farther is drawn first.
    glass(red, 0.25F, 0.5F);
    glass(blue, 0.6F, -0.5F);
    const glm::vec3 expected = glm::mix(glm::mix(glm::vec3(1.0F), blue, 0.6F), red, 0.25F);
    // The sky is stored in half floats.
    expect_near(at(draw(), 0.0F, 0.0F), expected, 5e-4F);
    EXPECT_EQ(renderer_.report().drawn, 2);

    // An opaque surface hides what is behind it and shows through what is in front.
    add(square(), {.base_colour = glm::vec3(0.5F), .unlit = true});
    expect_near(at(draw(), 0.0F, 0.0F), glm::mix(glm::vec3(0.5F), red, 0.25F));
}

TEST_F(SurfaceTest, ABlendedSurfaceDoesNotHideOneBehindItInTheSamePlace) {
    // Equal distance of the centres: both must show through, so neither writes depth.
    const auto glass = [&](float turn) {
        add(square(),
            {.base_colour = glm::vec3(0.0F),
             .alpha = 0.5F,
             .alpha_mode = AlphaMode::Blend,
             .double_sided = true,
             .unlit = true},
            glm::rotate(glm::mat4(1.0F), turn, {0.0F, 1.0F, 0.0F}));
    };
    renderer_.set_probe(even_light(1.0F));
    glass(0.6F);
    glass(-0.6F);
    EXPECT_NEAR(at(draw(), -0.4F, 0.0F).r, 0.25F, 5e-4F);
    EXPECT_NEAR(at(draw(), 0.4F, 0.0F).r, 0.25F, 5e-4F);
}

TEST_F(SurfaceTest, AnOutlineWhoseNormalsTurnAwayMirrorsWhatIsBehindIt) {
    // Bright above, black ahead.
    lighting::LightProbe probe = even_light(1.0F);
    lighting::CubeLayout& layout = probe.environment.layout;
    layout = {.face_size = 16, .levels = 1};
    probe.environment.halves.assign(3 * layout.offset(1), 0);
    probe.ambient = {};
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < layout.face_size; ++row)
            for (int column = 0; column < layout.face_size; ++column) {
                const double s = (2.0 * column + 1.0) / layout.face_size - 1.0;
                const double t = (2.0 * row + 1.0) / layout.face_size - 1.0;
                if (lighting::cube_direction(face, s, t).y < 0.2) continue;
                const std::size_t texel = 3 * layout.index(0, face, column, row);
                std::fill_n(probe.environment.halves.begin() + static_cast<std::ptrdiff_t>(texel), 3, 0x3C00);
            }
    renderer_.set_probe(std::move(probe));
    scene::Mesh mesh = square();
    mesh.normals.assign(4, {0.0F, -0.8F, -0.6F});
    add(std::move(mesh), {.base_colour = glm::vec3(0.0F), .roughness = 0.0F});
    const auto pixels = draw();
    EXPECT_LT(at(pixels, 0.0F, 0.0F).g, 0.01F);
}

/// KHR_materials_clearcoat on the engine's own surface, against the formula on the CPU.
class ClearCoat : public test::RenderTest {
 protected:
    /// The middle pixel of a square, whose view is along its normal.
    glm::dvec3 middle(float coat, float roughness) {
        const ecs::Entity entity =
            add(square(),
                {.base_colour = kCoated, .roughness = 0.6F, .clear_coat = coat, .clear_coat_roughness = roughness});
        const glm::dvec3 pixel(at(draw(), 0.0F, 0.0F));
        world_.destroy(entity);
        return pixel;
    }
    static constexpr glm::vec3 kCoated{0.5F, 0.3F, 0.1F};
};

/// 4 % of a white surrounding, and all but 4 % of what is under it. The split sum's table: 5e-3 of a lobe.
TEST_F(ClearCoat, MirrorsTheSurroundingsAndDimsTheBase) {
    renderer_.set_probe(even_light(1.0F));
    const glm::dvec3 bare = middle(0.0F, 0.0F);
    for (const float coat : {0.5F, 1.0F}) {
        const glm::dvec3 coated = middle(coat, 0.0F);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(coated[c], double{coat} * 0.04 + (1.0 - double{coat} * 0.04) * bare[c], 1e-3) << coat;
    }
}

/// The coat's highlight is that of a black dielectric of its roughness; the base's stays, dimmed by 4 %.
TEST_F(ClearCoat, LightsHaveHighlightsInIt) {
    const glm::dvec3 l = glm::normalize(glm::dvec3(0.1, 0.0, 1.0));
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::vec3(l), .irradiance = glm::vec3(1.0F)});
    const glm::dvec3 v(0.0, 0.0, 1.0);
    const glm::dvec3 base = test::reflected(l, v, v, glm::dvec3(kCoated), 0.0, 0.6);
    const glm::dvec3 highlight = test::reflected(l, v, v, glm::dvec3(0.0), 0.0, 0.4);
    EXPECT_GT(highlight.x, 0.1);
    const glm::dvec3 coated = middle(1.0F, 0.4F);
    // The table's error times 4 %.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(coated[c], highlight[c] + 0.96 * base[c], 2e-3 * base[c] + 1e-4 * highlight[c]);
    const glm::dvec3 bare = middle(0.0F, 0.4F);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(bare[c], base[c], 1e-4 * base[c]);
}

/// Drivers may truncate what is drawn into half floats.
TEST_F(SurfaceTest, WhatIsDrawnIntoHalfFloatsIsRounded) {
    renderer_.set_probe(even_light(0.7F));
    add(square(0.5F), {.base_colour = {0.3F, 0.2F, 0.9F}, .roughness = 0.4F});
    const auto not_rounded = [&](gpu::Format format) {
        const test::WideHalves wide;
        const gpu::Framebuffer target({.width = kSize, .height = kSize, .colours = {format}, .depth = true});
        renderer_.render(world_, camera_, target);
        return test::not_halves(target.read_rgba_float());
    };
    EXPECT_EQ(not_rounded(gpu::Format::RGBA16F), 0);
    EXPECT_GT(not_rounded(gpu::Format::RGBA32F), 100);
}

}  // namespace
}  // namespace rowland::render
