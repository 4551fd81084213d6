#include "engine/render/scene_instance.h"

#include <glm/gtc/matrix_transform.hpp>

#include "engine/render/surface_textures.h"
#include "tests/gpu/render_test.h"
#include "tests/support/expect.h"

namespace rowland::render {
namespace {

/// Component of the test's own kind of surface.
struct Marked {
    int number = 0;
    std::string pointer;
    bool had_mesh_and_material = false;
    bool had_another_beside = false;
};

/// A material type that marks the entities with its extension and draws none.
class MarkType final : public MaterialType {
 public:
    std::string name() const override { return "mark"; }
    std::string gltf_extension() const override { return "TEST_mark"; }
    std::vector<std::string> gltf_extensions_beside() const override { return {"TEST_beside"}; }
    void attach(ecs::World& world, ecs::Entity entity, const MaterialExtension& extension,
                SurfaceTextures& /*textures*/) override {
        if (!extension.object.contains("number")) refuse_input(extension.file, extension.pointer, "none", "a number");
        world.add(entity, Marked{extension.object["number"].get<int>(), extension.pointer,
                                 world.find<MeshInstance>(entity) && world.find<StandardMaterial>(entity),
                                 extension.material.extensions.contains("TEST_beside")});
        if (extension.object.contains("tables")) extension.tables("TEST_mark");
    }
    void add_shaders(gpu::ShaderLibrary& /*library*/) const override {}
    bool owns(ecs::World& /*world*/, ecs::Entity /*entity*/) const override { return false; }
    gpu::ProgramDesc program(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/) const override {
        return {};
    }
    void update(ecs::World& /*world*/, std::span<const FrameLight> /*lights*/,
                std::span<const LitEntity> /*seen*/) override {}
    void bind(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/,
              const gpu::Program& /*program*/) const override {}
};

class SceneInstanceTest : public test::RenderTest {
 protected:
    /// A parent node moved up by 0.5, its child turned a quarter about z with a square of half size 0.25 on it.
    static scene::ImportedScene two_nodes() {
        scene::ImportedScene scene;
        scene.meshes = {square(0.25F)};
        scene.nodes.resize(2);
        scene.nodes[0].local.translation = {0.0F, 0.5F, 0.0F};
        scene.nodes[1].parent = 0;
        scene.nodes[1].name = "disc";
        scene.nodes[1].extras = {{"grab", true}};
        scene.nodes[1].local.rotation = glm::angleAxis(1.5707963F, glm::vec3(0.0F, 0.0F, 1.0F));
        scene.instances = {{.name = "square", .mesh = 0, .material = 0, .node = 1, .skin = {}}};
        scene.materials.resize(1);
        scene.materials[0].unlit = true;
        return scene;
    }
    static std::shared_ptr<const image::ByteImage> picture(int width, const std::vector<glm::u8vec4>& texels) {
        auto made = std::make_shared<image::ByteImage>();
        made->width = width;
        made->height = static_cast<int>(texels.size()) / width;
        for (const glm::u8vec4& texel : texels)
            for (int c = 0; c < 4; ++c) made->rgba.push_back(texel[c]);
        return made;
    }
    std::vector<glm::vec4> draw_updated() {
        scene::update_world_matrices(world_);
        return draw();
    }
};

TEST_F(SceneInstanceTest, NodesBecomeEntitiesAndPrimitivesTheirChildren) {
    const SceneInstance instance = instantiate(world_, two_nodes(), renderer_, "test.gltf");
    ASSERT_EQ(instance.nodes.size(), 2U);
    ASSERT_EQ(instance.drawn.size(), 1U);
    EXPECT_EQ(world_.get<scene::Parent>(instance.nodes[1]).entity, instance.nodes[0]);
    EXPECT_EQ(world_.get<scene::NodeMetadata>(instance.nodes[1]).name, "disc");
    EXPECT_EQ(world_.get<scene::NodeMetadata>(instance.nodes[1]).extras, nlohmann::json({{"grab", true}}));
    EXPECT_EQ(world_.get<scene::Parent>(instance.drawn[0]).entity, instance.nodes[1]);
    const auto pixels = draw_updated();
    EXPECT_EQ(at(pixels, 0.0F, 0.5F).g, 1.0F);
    EXPECT_EQ(at(pixels, 0.0F, 0.0F).g, 0.0F);

    destroy(world_, instance);
    EXPECT_EQ(world_.living(), 0U);
}

TEST_F(SceneInstanceTest, AMaterialIsCarriedOverWhole) {
    scene::ImportedScene scene = two_nodes();
    scene::MaterialDescription& material = scene.materials[0];
    material = {};
    material.base_colour = {0.1F, 0.2F, 0.3F, 0.4F};
    material.metallic = 0.5F;
    material.roughness = 0.6F;
    material.emissive = {0.7F, 0.8F, 0.9F};
    material.normal_scale = 0.25F;
    material.occlusion_strength = 0.75F;
    material.alpha_mode = scene::AlphaMode::Mask;
    material.alpha_cutoff = 0.35F;
    material.double_sided = true;
    scene.instances.push_back({.name = "bare", .mesh = 0, .material = {}, .node = 0, .skin = {}});
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    const StandardMaterial& made = world_.get<StandardMaterial>(instance.drawn[0]);
    EXPECT_EQ(made.base_colour, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(made.alpha, 0.4F);
    EXPECT_EQ(made.metallic, 0.5F);
    EXPECT_EQ(made.roughness, 0.6F);
    EXPECT_EQ(made.emissive, glm::vec3(0.7F, 0.8F, 0.9F));
    EXPECT_EQ(made.normal_scale, 0.25F);
    EXPECT_EQ(made.occlusion_strength, 0.75F);
    EXPECT_EQ(made.alpha_mode, scene::AlphaMode::Mask);
    EXPECT_EQ(made.alpha_cutoff, 0.35F);
    EXPECT_TRUE(made.double_sided);
    EXPECT_FALSE(made.unlit);
    // No material: glTF's default.
    const StandardMaterial& bare = world_.get<StandardMaterial>(instance.drawn[1]);
    EXPECT_EQ(bare.base_colour, glm::vec3(1.0F));
    EXPECT_EQ(bare.metallic, 1.0F);
    EXPECT_EQ(bare.roughness, 1.0F);
    // Instances of one mesh share it.
    EXPECT_EQ(world_.get<MeshInstance>(instance.drawn[0]).gpu, world_.get<MeshInstance>(instance.drawn[1]).gpu);
}

TEST_F(SceneInstanceTest, AColourTextureIsDecodedFromSrgbWithItsTopAtVZero) {
    scene::ImportedScene scene = two_nodes();
    scene.nodes[1].local = {};
    scene.images = {picture(1, {{188, 188, 188, 255}, {0, 0, 0, 255}})};
    scene.textures = {{.image = 0, .nearest = true}};
    scene.materials[0].base_colour_texture = scene::TextureUse{};
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    const auto pixels = draw_updated();
    // sRGB 188 is linear ((188/255 + 0.055) / 1.055)^2.4 = 0.50289; drivers may be off by half an 8-bit step, 0.0029.
    EXPECT_NEAR(at(pixels, 0.0F, 0.62F).g, 0.50289F, 2.9e-3F);
    EXPECT_EQ(at(pixels, 0.0F, 0.38F).g, 0.0F);
}

TEST_F(SceneInstanceTest, ATextureIsUploadedOnceForEachMeaningAndSampling) {
    scene::ImportedScene scene;
    scene.images = {picture(1, {{128, 128, 128, 255}})};
    scene.textures = {{.image = 0}, {.image = 0}, {.image = 0, .wrap_s = scene::TextureWrap::Mirror}};
    SurfaceTextures textures(scene);
    const SurfaceTexture first = textures.get({.texture = 0, .uv_set = 0, .transform = {}}, TexelMeaning::Linear);
    EXPECT_EQ(textures.get({.texture = 1, .uv_set = 1, .transform = {}}, TexelMeaning::Linear).texture, first.texture);
    EXPECT_EQ(textures.uploads(), 1U);
    EXPECT_NE(textures.get({.texture = 0, .uv_set = 0, .transform = {}}, TexelMeaning::Srgb).texture, first.texture);
    EXPECT_NE(textures.get({.texture = 2, .uv_set = 0, .transform = {}}, TexelMeaning::Linear).texture, first.texture);
    EXPECT_EQ(textures.uploads(), 3U);
    EXPECT_EQ(first.texture->desc().format, gpu::Format::RGBA8);
}

TEST_F(SceneInstanceTest, MipmapsShowTheMeanOfATextureFarAway) {
    scene::ImportedScene scene = two_nodes();
    scene.nodes[1].local = {};
    std::vector<glm::u8vec4> checkers;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) checkers.emplace_back(glm::u8vec3((x + y) % 2 == 0 ? 255 : 0), 255);
    scene.images = {picture(64, checkers)};
    scene.textures = {{.image = 0}};
    scene.materials[0].base_colour_texture = scene::TextureUse{};
    instantiate(world_, scene, renderer_, "test.gltf");
    // Seven pixels for 64 texels. A driver that averages without decoding shows sRGB ½: 0.214.
    const float mean = at(draw_updated(), 0.0F, 0.5F).g;
    EXPECT_GT(mean, 0.2F);
    EXPECT_LT(mean, 0.55F);
}

TEST_F(SceneInstanceTest, AnimationMovesTheNodesAndWhatHangsOnThem) {
    scene::ImportedScene scene = two_nodes();
    scene.animations = {{.name = "down",
                         .channels = {{.node = 0,
                                       .property = scene::AnimatedProperty::Translation,
                                       .times_s = {0.0F, 2.0F},
                                       .values = {{0.0F, 0.5F, 0.0F, 0.0F}, {0.0F, -0.5F, 0.0F, 0.0F}}}},
                         .duration_s = 2.0F}};
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    instance.animate(world_, 0, 2.0F);
    const auto pixels = draw_updated();
    EXPECT_EQ(at(pixels, 0.0F, 0.5F).g, 0.0F);
    EXPECT_EQ(at(pixels, 0.0F, -0.5F).g, 1.0F);
    instance.animate(world_, 0, 1.0F);
    EXPECT_EQ(at(draw_updated(), 0.0F, 0.0F).g, 1.0F);
}

TEST_F(SceneInstanceTest, ASkinnedPrimitiveStandsWhereItsJointsAre) {
    scene::ImportedScene scene = two_nodes();
    scene.meshes[0].joints.assign(4, glm::u16vec4(0));
    scene.meshes[0].weights.assign(4, {1.0F, 0.0F, 0.0F, 0.0F});
    scene.skins = {{.joints = {0}, .inverse_bind = {glm::translate(glm::mat4(1.0F), {0.25F, 0.0F, 0.0F})}}};
    scene.instances[0].skin = 0;
    scene.nodes[1].local.translation = {9.0F, 9.0F, 9.0F};  // its own node does not move it
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    EXPECT_EQ(world_.find<scene::Parent>(instance.drawn[0]), nullptr);
    const auto pixels = draw_updated();
    EXPECT_EQ(at(pixels, 0.45F, 0.5F).g, 1.0F);
    EXPECT_EQ(at(pixels, -0.15F, 0.5F).g, 0.0F);
}

TEST_F(SceneInstanceTest, LightsHangOnTheirNodes) {
    scene::ImportedScene scene = two_nodes();
    scene.materials[0] = {};
    scene.nodes.push_back({});
    scene.nodes[2].local.translation = {0.0F, 0.5F, 1.0F};
    scene.lights = {{.node = 2, .light = scene::PunctualLight{.intensity = glm::vec3(1.0F)}}};
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    ASSERT_EQ(instance.lights.size(), 1U);
    EXPECT_GT(at(draw_updated(), 0.0F, 0.5F).g, 0.05F);
    world_.get<scene::Transform>(instance.nodes[2]).translation.z = -1.0F;  // behind the square
    EXPECT_EQ(at(draw_updated(), 0.0F, 0.5F).g, 0.0F);
    destroy(world_, instance);
    EXPECT_EQ(world_.living(), 0U);
}

TEST_F(SceneInstanceTest, WhatIsBelowANodeThatReflectsObjectsIsOneGroup) {
    scene::ImportedScene scene = two_nodes();
    EXPECT_FALSE(world_.find<ReflectsObjects>(instantiate(world_, scene, renderer_, "test.gltf").drawn[0]));
    scene.nodes[0].extras = {{"reflects_objects", true}};
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    EXPECT_EQ(world_.get<ReflectsObjects>(instance.drawn[0]).group, instance.nodes[0]);
}

TEST_F(SceneInstanceTest, AMaterialExtensionReachesTheTypeThatHandlesIt) {
    EXPECT_TRUE(renderer_.gltf_extensions().empty());
    renderer_.add_material_type(std::make_unique<MarkType>());
    EXPECT_EQ(renderer_.gltf_extensions(), (std::vector<std::string>{"TEST_mark", "TEST_beside"}));
    scene::ImportedScene scene = two_nodes();
    scene.materials[0].extensions = {{"TEST_other", nlohmann::json::object()}, {"TEST_mark", {{"number", 7}}}};
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    const Marked* marked = world_.find<Marked>(instance.drawn[0]);
    ASSERT_NE(marked, nullptr);
    EXPECT_EQ(marked->number, 7);
    EXPECT_EQ(marked->pointer, "/materials/0/extensions/TEST_mark");
    EXPECT_TRUE(marked->had_mesh_and_material);
    EXPECT_FALSE(marked->had_another_beside);
}

TEST_F(SceneInstanceTest, AnExtensionBesideATypesOwnIsReadByItAndAloneIsWarnedOfOnce) {
    renderer_.add_material_type(std::make_unique<MarkType>());
    scene::ImportedScene scene = two_nodes();
    scene.materials[0].extensions = {{"TEST_beside", nlohmann::json::object()}, {"TEST_mark", {{"number", 7}}}};
    testing::internal::CaptureStderr();
    const SceneInstance instance = instantiate(world_, scene, renderer_, "test.gltf");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_TRUE(world_.get<Marked>(instance.drawn[0]).had_another_beside);

    scene.materials[0].extensions.erase("TEST_mark");
    scene.instances.push_back(scene.instances[0]);
    testing::internal::CaptureStderr();
    instantiate(world_, scene, renderer_, "test.gltf");
    const std::string warning = "/materials/0/extensions/TEST_beside is ignored without TEST_mark";
    const std::string said = testing::internal::GetCapturedStderr();
    ASSERT_NE(said.find(warning), std::string::npos) << said;
    EXPECT_EQ(said.find(warning, said.find(warning) + 1), std::string::npos) << said;
}

TEST_F(SceneInstanceTest, AWrongExtensionLeavesTheWorldAsItWas) {
    renderer_.add_material_type(std::make_unique<MarkType>());
    scene::ImportedScene scene = two_nodes();
    // The second one takes tables, but the scene has not been cooked.
    for (const nlohmann::json& wrong : {nlohmann::json::object(), nlohmann::json{{"number", 1}, {"tables", true}}}) {
        scene.materials[0].extensions = {{"TEST_mark", wrong}};
        const std::string message = test::message_of([&] { instantiate(world_, scene, renderer_, "test.gltf"); });
        EXPECT_NE(message.find("test.gltf"), std::string::npos) << message;
        EXPECT_NE(message.find("/materials/0/extensions/TEST_mark"), std::string::npos) << message;
        EXPECT_EQ(message.find("rowland-cook") != std::string::npos, wrong.contains("tables")) << message;
        EXPECT_EQ(world_.living(), 0U);
    }
}

}  // namespace
}  // namespace rowland::render
