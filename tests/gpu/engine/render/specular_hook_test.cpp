// Material types that take part in the base's specular reflection, and two types on one entity.

#include "engine/render/scene_instance.h"
#include "tests/gpu/render_test.h"
#include "tests/support/expect.h"

namespace rowland::render {
namespace {

constexpr const char* kBeforeHook = R"(#version 450 core
#define MATERIAL_SPECULAR
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"
vec3 reflect_specular(vec3 light, vec3 f0, float cosine) { return )";
constexpr const char* kAfterHook = R"(; }
#include "engine/render/shaders/shading.glsl"
void main() { write_surface(MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0))); }
)";

/// Draws every entity that has a StandardMaterial, with a specular function of the test's.
class HookType final : public MaterialType {
 public:
    HookType(std::string name, const std::string& reflected)
        : name_(std::move(name)), text_(kBeforeHook + reflected + kAfterHook) {}

    std::string name() const override { return name_; }
    void add_shaders(gpu::ShaderLibrary& library) const override { library.add(name_ + ".frag.glsl", text_); }
    bool owns(ecs::World& world, ecs::Entity entity) const override {
        return world.find<StandardMaterial>(entity) != nullptr;
    }
    gpu::ProgramDesc program(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/) const override {
        return {.vertex = "engine/render/shaders/plain.vert.glsl", .fragment = name_ + ".frag.glsl"};
    }
    void update(ecs::World& /*world*/, std::span<const FrameLight> /*lights*/,
                std::span<const LitEntity> /*seen*/) override {}
    void bind(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/,
              const gpu::Program& /*program*/) const override {}

 private:
    std::string name_;
    std::string text_;
};

class SpecularHook : public test::RenderTest {
 protected:
    void use(const std::string& name, const std::string& reflected) {
        renderer_.add_material_type(std::make_unique<HookType>(name, reflected));
    }
    void add_sun(const glm::vec3& irradiance) {
        world_.add(world_.create(), scene::DirectionalLight{.direction = kSun, .irradiance = irradiance});
    }
    static glm::dvec3 view_at(float x, float y) {
        return glm::normalize(glm::dvec3(0.0, 0.0, kEye) - glm::dvec3(position_of(x, y)));
    }
    const glm::vec3 kSun = glm::normalize(glm::vec3(0.6F, 0.3F, 0.9F));
};

TEST_F(SpecularHook, SchlicksOwnFunctionDrawsThePlainSurface) {
    renderer_.set_probe(even_light(0.7F));
    add_sun({1.0F, 2.0F, 0.5F});
    const ecs::Entity lamp = world_.create();
    world_.add(lamp, scene::PunctualLight{.intensity = {0.3F, 0.2F, 0.4F}});
    world_.add(lamp, scene::WorldMatrix{glm::mat4(1.0F)});
    world_.get<scene::WorldMatrix>(lamp).matrix[3] = {0.3F, 0.4F, 0.8F, 1.0F};
    const ecs::Entity surface = add(square(), {});
    Renderer hooked(glm::inverse(colour::rec709_to_xyz()));
    hooked.set_probe(even_light(0.7F));
    hooked.add_material_type(std::make_unique<HookType>("schlick", "light * schlick_reflectance(f0, cosine)"));
    for (const glm::vec3& eye : {glm::vec3(0.0F, 0.0F, kEye), glm::vec3(2.6F, 1.0F, 0.35F)}) {
        camera_.eye = eye;
        for (const float roughness : {0.05F, 0.3F, 0.8F}) {
            world_.add(surface,
                       StandardMaterial{.base_colour = {0.5F, 0.3F, 0.1F}, .metallic = 0.5F, .roughness = roughness});
            const std::vector<glm::vec4> plain = draw();
            hooked.render(world_, camera_, target_);
            const std::vector<glm::vec4> pixels = target_.read_rgba_float();
            // Where the view's own angle is taken for the lobe's mean, the table's interpolation of (1 - cosine)^5
            // shows: (1/64)^2 / 8 of its second derivative, 20 at the horizon.
            for (std::size_t i = 0; i < pixels.size(); ++i)
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixels[i][c], plain[i][c], 1e-3 * (1.0 + plain[i][c])) << i;
        }
    }
}

TEST_F(SpecularHook, MixesTheColoursOfDirectLightByItsAngle) {
    const double roughness = 0.4;
    add(square(), {.base_colour = glm::vec3(0.0F), .metallic = 1.0F, .roughness = static_cast<float>(roughness)});
    add_sun({1.0F, 2.0F, 0.5F});
    use("turned", "light.gbr * cosine");
    const auto pixels = draw();
    for (const glm::vec2 p : {glm::vec2(0.0F), glm::vec2(0.4F, 0.2F), glm::vec2(-0.6F, 0.7F)}) {
        const glm::dvec3 v = view_at(p.x, p.y);
        const glm::dvec3 l(kSun);
        const double cosine = glm::dot(v, glm::normalize(l + v));
        // All reflected, whatever the angle, by a metal of base colour 1.
        const glm::dvec3 whole = test::reflected(l, {0.0, 0.0, 1.0}, v, glm::dvec3(1.0), 1.0, roughness);
        const glm::dvec3 expected = glm::dvec3(2.0, 0.5, 1.0) * cosine * whole;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(pixels, p.x, p.y)[c], expected[c], 1e-6 + 3e-5 * expected[c]) << p.x;
    }
}

TEST_F(SpecularHook, MixesTheColoursOfTheEnvironmentByTheViewsAngleOnASmoothSurface) {
    lighting::LightProbe probe = even_light(1.0F);
    for (std::size_t i = 0; i < probe.environment.halves.size(); i += 3) probe.environment.halves[i] = 0x4000;  // 2
    renderer_.set_probe(probe);
    add(square(), {.base_colour = glm::vec3(0.0F), .metallic = 1.0F, .roughness = 0.0F});
    use("turned", "light.gbr * cosine");
    camera_.eye = {2.0F, 0.0F, 1.5F};
    const auto pixels = draw();
    const glm::vec4 centre = pixels[kSize / 2 * kSize + kSize / 2];
    // The table's albedo of a smooth lobe is 1 to 5e-3.
    EXPECT_NEAR(centre.r, 0.6F, 4e-3F);
    EXPECT_NEAR(centre.g, 0.6F, 4e-3F);
    EXPECT_NEAR(centre.b, 1.2F, 8e-3F);
}

TEST_F(SpecularHook, TwoMaterialTypesOnOneEntityAreAnErrorThatNamesBothAndTheEntity) {
    const ecs::Entity entity = add(square(), {});
    const ecs::Entity node = world_.create();
    world_.add(node, scene::NodeMetadata{.name = "teapot", .extras = {}});
    world_.add(entity, scene::Parent{node});
    use("first kind", "light");
    draw();
    use("second kind", "light");
    const std::string message = test::message_of([&] { draw(); });
    for (const char* part : {"first kind", "second kind", "teapot"})
        EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST_F(SpecularHook, ASceneWhoseSurfaceTwoTypesClaimIsRefusedWithItsFileAndMaterial) {
    scene::ImportedScene scene;
    scene.meshes = {square()};
    scene.nodes.resize(1);
    scene.nodes[0].name = "teapot";
    scene.materials.resize(2);
    scene.instances = {{.name = "square", .mesh = 0, .material = 1, .node = 0, .skin = {}}};
    use("first kind", "light");
    use("second kind", "light");
    const std::string message = test::message_of([&] { instantiate(world_, scene, renderer_, "scene.gltf"); });
    for (const char* part : {"scene.gltf", "/materials/1", "first kind", "second kind", "teapot"})
        EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(world_.living(), 0U);
}

}  // namespace
}  // namespace rowland::render
