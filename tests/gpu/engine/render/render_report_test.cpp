// What a frame draws, culls, compiles and measures; skins; parts of the picture.
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/gpu/render_test.h"
#include "tests/support/files.h"

namespace rowland::render {
namespace {

const StandardMaterial kUnlit{.base_colour = glm::vec3(1.0F), .unlit = true};

class RenderReportTest : public test::RenderTest {
 protected:
    static glm::mat4 translation(float x, float y, float z) { return glm::translate(glm::mat4(1.0F), {x, y, z}); }
};

TEST_F(RenderReportTest, ObjectsOutsideThePictureAreNotDrawn) {
    add(square(), kUnlit);
    add(square(), kUnlit, translation(0.0F, 0.0F, 20.0F));    // behind the camera
    add(square(), kUnlit, translation(9.0F, 0.0F, 0.0F));     // right
    add(square(), kUnlit, translation(0.0F, -9.0F, 0.0F));    // below
    add(square(), kUnlit, translation(0.0F, 0.0F, -300.0F));  // beyond the far plane
    draw();
    EXPECT_EQ(renderer_.report().drawn, 1);
    EXPECT_EQ(renderer_.report().culled, 4);
}

TEST_F(RenderReportTest, AnObjectThatIsPartlyInThePictureIsDrawn) {
    // Its centre is out of the picture, its left edge at x = 1.1 is in.
    add(square(), kUnlit, translation(2.1F, 0.0F, 0.0F));
    EXPECT_EQ(at(draw(), 1.15F, 0.0F).g, 1.0F);
    EXPECT_EQ(renderer_.report().culled, 0);
}

TEST_F(RenderReportTest, ASkinnedMeshIsCulledByItsPose) {
    scene::Mesh mesh = square();
    mesh.joints.assign(4, glm::u16vec4(0));
    mesh.weights.assign(4, {1.0F, 0.0F, 0.0F, 0.0F});
    for (glm::vec3& position : mesh.positions) position.x += 50.0F;  // at rest far outside
    const ecs::Entity joint = world_.create();
    world_.add(joint, scene::WorldMatrix{translation(-50.0F, 0.0F, 0.0F)});
    const ecs::Entity entity = add(mesh, kUnlit);
    world_.add(entity, scene::Skin{.joints = {joint}, .inverse_bind = {glm::mat4(1.0F)}});
    EXPECT_EQ(at(draw(), 0.0F, 0.0F).g, 1.0F);
    world_.get<scene::WorldMatrix>(joint).matrix = glm::mat4(1.0F);
    draw();
    EXPECT_EQ(renderer_.report().culled, 1);
}

TEST_F(RenderReportTest, ASkinnedMeshIsDrawnAsTheCpuPosesIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-0.3F, 0.3F);
    // A strip in the picture's plane, bent by three joints of unequal weights.
    scene::Mesh mesh;
    constexpr int kSegments = 6;
    for (int i = 0; i <= kSegments; ++i)
        for (const float y : {-0.4F, 0.4F}) {
            const float t = static_cast<float>(i) / kSegments;
            mesh.positions.emplace_back(1.6F * t - 0.8F, y, 0.0F);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            mesh.tangents.emplace_back(1.0F, 0.0F, 0.0F, 1.0F);
            mesh.joints.emplace_back(2, 0, 1, 9999);  // the last has no weight and does not exist
            mesh.weights.emplace_back(t * t, (1.0F - t) * (1.0F - t), 2.0F * t * (1.0F - t), 0.0F);
        }
    for (std::uint32_t i = 0; i < kSegments; ++i)
        for (const std::uint32_t corner : {0U, 2U, 1U, 1U, 2U, 3U}) mesh.indices.push_back(2 * i + corner);

    scene::Skin skin;
    for (int j = 0; j < 3; ++j) {
        skin.joints.push_back(world_.create());
        glm::mat4 matrix = translation(uniform(random), uniform(random), uniform(random));
        matrix = glm::rotate(matrix, 2.0F * uniform(random), glm::normalize(glm::vec3(uniform(random), 0.5F, 0.2F)));
        world_.add(skin.joints.back(), scene::WorldMatrix{glm::scale(matrix, {1.0F, 1.0F + uniform(random), 1.0F})});
        skin.inverse_bind.push_back(translation(uniform(random), 0.1F, 0.0F));
    }
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.7F, 0.4F, 0.8F)),
                                                        .irradiance = glm::vec3(3.0F)});
    StandardMaterial material{.base_colour = glm::vec3(0.5F), .roughness = 0.4F, .double_sided = true};
    material.normal_texture = texture(1, {{0.7F, 0.6F, 0.9F, 1.0F}});  // the tangent matters

    // Another skinned mesh before it in the buffer of joints.
    scene::Mesh other = square(0.1F);
    other.joints.assign(4, glm::u16vec4(1, 0, 0, 0));
    other.weights.assign(4, {1.0F, 0.0F, 0.0F, 0.0F});
    world_.add(add(other, material), scene::Skin(skin));
    const ecs::Entity entity = add(mesh, material);
    mesh.uvs.clear();
    world_.add(entity, scene::Skin(skin));
    const auto on_gpu = draw();

    world_.remove<scene::Skin>(entity);
    const std::vector<glm::mat4> joints = scene::joint_matrices(world_, skin);
    scene::Mesh posed = scene::posed(mesh, joints);
    posed.joints.clear();
    posed.weights.clear();
    world_.add(entity, make_mesh_instance(std::move(posed)));
    const auto on_cpu = draw();
    int lit = 0;
    int differing = 0;
    for (std::size_t i = 0; i < on_cpu.size(); ++i) {
        lit += on_cpu[i].g > 0.05F ? 1 : 0;
        // Positions that differ by 1e-5 of the size sometimes move an edge across a pixel's centre; within, shading
        // differs by less than a thousandth.
        differing += std::abs(on_cpu[i].g - on_gpu[i].g) > 1e-3F * (1.0F + on_cpu[i].g) ? 1 : 0;
    }
    EXPECT_GT(lit, 150);
    EXPECT_LE(differing, 1);
}

TEST_F(RenderReportTest, ProgramsAreCompiledInTheFirstFrameOfASurfaceAndNeverElse) {
    EXPECT_EQ(renderer_.report().programs, 0);
    add(square(), {});
    add(square(0.5F), {.base_colour = glm::vec3(0.3F), .metallic = 1.0F});
    draw();
    EXPECT_EQ(renderer_.report().programs, 2);  // the plain surface and the sky
    draw(Shading::Unlit);
    EXPECT_EQ(renderer_.report().programs, 3);

    add(square(), {.base_colour_texture = texture(1, {glm::vec4(1.0F)})}, translation(50.0F, 0.0F, 0.0F));
    draw();
    EXPECT_EQ(renderer_.report().programs, 4);  // not in the picture, but it may come
    add(square(), {.base_colour_texture = texture(1, {glm::vec4(1.0F)})});
    add(square(), {.base_colour_texture = texture(1, {glm::vec4(0.5F)})});
    draw();
    EXPECT_EQ(renderer_.report().programs, 4);  // one for all

    world_.add(world_.create(), scene::DirectionalLight{.irradiance = glm::vec3(1.0F), .casts_shadow = true});
    draw();
    EXPECT_EQ(renderer_.report().programs, 4 + 3);  // both surfaces with a light and its shadow, and the map's own
    draw();
    EXPECT_EQ(renderer_.report().programs, 7);
}

TEST_F(RenderReportTest, ReloadedShadersReachEveryVariant) {
    add(square(), {.base_colour = glm::vec3(1.0F), .unlit = true}, translation(-1.0F, 0.0F, 0.0F));
    add(square(), {.base_colour_texture = texture(1, {glm::vec4(1.0F)}), .unlit = true}, translation(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(at(draw(), -0.5F, 0.0F).r, 1.0F);
    const test::TemporaryFolder tree;
    write_file_atomic(
        tree.path() / "engine/render/shaders/shading.glsl",
        "layout(location = 0) out vec4 radiance;\n"
        "struct MaterialTerms { vec3 base_weight; vec3 mirror_weight; vec3 added; };\n"
        "void write_surface(MaterialTerms terms) { radiance = vec4(7.0, surface_colour().a, 0.0, 1.0); }\n");
    renderer_.reload_shaders(tree.path());
    const auto pixels = draw();
    EXPECT_EQ(at(pixels, -0.5F, 0.0F).r, 7.0F);
    EXPECT_EQ(at(pixels, 0.5F, 0.0F).r, 7.0F);
}

TEST_F(RenderReportTest, PassTimesAreListedByNameAndPositive) {
    gpu::PassTimes times;
    renderer_.set_pass_times(&times);
    add(square(), {});
    add(square(0.5F), {.alpha = 0.5F, .alpha_mode = scene::AlphaMode::Blend});
    world_.add(world_.create(), scene::DirectionalLight{.irradiance = glm::vec3(1.0F), .casts_shadow = true});
    for (int frame = 0; frame < 6; ++frame) {
        times.begin_frame();
        draw();
    }
    glFinish();
    times.begin_frame();
    draw();
    std::vector<std::string> names;
    for (const gpu::PassTime& pass : renderer_.report().passes) {
        names.push_back(pass.name);
        EXPECT_GT(pass.cpu_ms, 0.0) << pass.name;
        ASSERT_TRUE(pass.gpu_ms.has_value()) << pass.name;
        EXPECT_GT(*pass.gpu_ms, 0.0) << pass.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"shadow", "opaque", "sky", "blend"}));

    renderer_.set_pass_times(nullptr);
    draw();
    EXPECT_TRUE(renderer_.report().passes.empty());
}

void expect_near(const glm::vec4& drawn, const glm::vec3& expected, const std::string& where) {
    // 32-bit floats, through two matrices.
    EXPECT_LT(glm::length(glm::vec3(drawn) - expected), 1e-5F) << where << ": " << drawn.r << ", " << drawn.b;
}

class PictureColumnsTest : public test::RenderTest {
 protected:
    ecs::Entity add_square(const glm::vec3& colour, PictureColumns columns) {
        const ecs::Entity entity = add(square(), {.base_colour = colour, .unlit = true});
        world_.add(entity, columns);
        return entity;
    }
    static constexpr glm::vec3 kRed{1.0F, 0.0F, 0.0F};
    static constexpr glm::vec3 kBlue{0.0F, 0.0F, 1.0F};
};

TEST_F(PictureColumnsTest, TwoInOnePlaceShareThePictureAtTheLine) {
    add_square(kRed, {0.0F, 0.6F});
    add_square(kBlue, {0.6F, 1.0F});
    const auto pixels = draw();
    const int line = static_cast<int>(std::lround(0.6F * kSize));
    for (int column = 5; column < kSize - 5; ++column) {
        const glm::vec4 pixel = pixels[static_cast<std::size_t>(kSize / 2 * kSize + column)];
        expect_near(pixel, column < line ? kRed : kBlue, "column " + std::to_string(column));
    }
}

TEST_F(PictureColumnsTest, WithoutThemAnEntityShowsEverywhereBesideOneThatHasThem) {
    add_square(kRed, {0.0F, 0.5F});
    add(square(), {.base_colour = kBlue, .unlit = true}, glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, -0.5F}));
    const auto pixels = draw();
    expect_near(at(pixels, -0.5F, 0.0F), kRed, "left");
    expect_near(at(pixels, 0.5F, 0.0F), kBlue, "right");
}

TEST_F(PictureColumnsTest, NoColumnsShowNothingAndAllShowAll) {
    const ecs::Entity entity = add_square(kRed, {0.7F, 0.7F});
    expect_near(at(draw(), 0.5F, 0.0F), glm::vec3(0.0F), "nothing");
    world_.get<PictureColumns>(entity) = {-3.0F, 4.0F};
    const auto pixels = draw();
    expect_near(at(pixels, -0.9F, 0.0F), kRed, "left");
    expect_near(at(pixels, 0.9F, 0.0F), kRed, "right");
}

}  // namespace
}  // namespace rowland::render
