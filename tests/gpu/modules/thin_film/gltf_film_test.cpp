// KHR_materials_iridescence in scenes.

#include "engine/render/scene_instance.h"
#include "modules/thin_film/module.h"
#include "modules/thin_film/runtime/film_surface.h"
#include "tests/gpu/render_test.h"
#include "tests/support/expect.h"

namespace rowland::thin_film {
namespace {

constexpr const char* kPointer = "/materials/0/extensions/KHR_materials_iridescence";

class GltfFilm : public rowland::test::RenderTest {
 protected:
    GltfFilm() { renderer_.set_probe(even_light(1.0F)); }

    /// One square with a cooked material of these extensions, and a texture of two texels side by side.
    scene::ImportedScene scene_with(const nlohmann::json& extensions, scene::AlphaMode alpha_mode) const {
        scene::ImportedScene scene;
        scene.meshes = {square()};
        scene.nodes.resize(1);
        auto image = std::make_shared<image::ByteImage>();
        image->width = 2;
        image->height = 1;
        image->rgba = {0, 0, 0, 255, 255, 255, 0, 255};
        scene.images = {image};
        scene.textures.resize(1);
        scene.textures[0].nearest = true;
        scene::MaterialDescription material;
        material.base_colour = {0.0F, 0.0F, 0.0F, 1.0F};
        if (alpha_mode == scene::AlphaMode::Blend) material.base_colour.a = 0.0F;
        material.alpha_mode = alpha_mode;
        material.metallic = 0.0F;
        material.roughness = 0.0F;
        for (const auto& [name, value] : extensions.items()) material.extensions[name] = value;
        if (const auto found = material.extensions.find(kIridescenceExtension); found != material.extensions.end())
            if (const auto film = film_material(parse_gltf_iridescence(found->second, "scene.gltf", kPointer), material,
                                                "scene.gltf", kPointer))
                material.tables[kIridescenceExtension] =
                    std::make_shared<const std::vector<std::byte>>(write_gltf_film(*film, bake_film(*film)));
        scene.materials = {material};
        scene.instances = {{.name = "square", .mesh = 0, .material = 0, .node = 0, .skin = {}}};
        return scene;
    }

    std::vector<glm::vec4> pixels_of(const nlohmann::json& extensions,
                                     scene::AlphaMode alpha_mode = scene::AlphaMode::Opaque) {
        const render::SceneInstance instance =
            render::instantiate(world_, scene_with(extensions, alpha_mode), renderer_, "scene.gltf");
        for (const ecs::Entity entity : instance.drawn) world_.add(entity, scene::WorldMatrix{glm::mat4(1.0F)});
        std::vector<glm::vec4> pixels = draw();
        render::destroy(world_, instance);
        return pixels;
    }

    /// White light that a film on a dielectric reflects toward the eye from the pixel at (x, 0), Rec.709.
    static glm::dvec3 exact(double ior, double thickness_nm, double base, float x) {
        const double cosine = glm::normalize(glm::dvec3(0.0, 0.0, kEye) - glm::dvec3(position_of(x, 0.0F))).z;
        const Film film{.layers = {{ior, thickness_nm}}, .base = std::complex<double>(base)};
        const FilmColour colour(film, colour::LightSpectra{});
        return glm::inverse(colour::rec709_to_xyz()) * (colour(cosine) * glm::dvec3(1.0));
    }

    void expect_at(const std::vector<glm::vec4>& pixels, float x, const glm::dvec3& expected) {
        const double scale = std::max({expected.r, expected.g, expected.b});
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(at(pixels, x, 0.0F)[c], std::max(expected[c], 0.0), 1e-2 * scale) << x << " " << c;
    }
};

TEST_F(GltfFilm, ThicknessGoesFromMinimumToMaximumByTheTexturesGreenEvenIfItFalls) {
    register_module(renderer_);
    for (const auto& [at_0_nm, at_1_nm] : {std::pair(150.0, 380.0), std::pair(380.0, 150.0)}) {
        const auto pixels = pixels_of({{"KHR_materials_iridescence",
                                        {{"iridescenceFactor", 1.0},
                                         {"iridescenceThicknessMinimum", at_0_nm},
                                         {"iridescenceThicknessMaximum", at_1_nm},
                                         {"iridescenceThicknessTexture", {{"index", 0}}}}}});
        expect_at(pixels, -0.5F, exact(1.3, at_0_nm, 1.5, -0.5F));
        expect_at(pixels, 0.5F, exact(1.3, at_1_nm, 1.5, 0.5F));
    }
}

TEST_F(GltfFilm, WithoutATextureIsAsThickAsTheMaximumOnTheBaseOfKhrMaterialsIor) {
    register_module(renderer_);
    const auto pixels =
        pixels_of({{"KHR_materials_ior", {{"ior", 1.0}}},
                   {"KHR_materials_iridescence",
                    {{"iridescenceFactor", 1.0}, {"iridescenceIor", 1.33}, {"iridescenceThicknessMaximum", 300.0}}}});
    expect_at(pixels, 0.2F, exact(1.33, 300.0, 1.0, 0.2F));
}

TEST_F(GltfFilm, TheFactorAndItsTextureMixItWithThePlainSurface) {
    const auto plain = pixels_of(nlohmann::json::object());
    register_module(renderer_);
    const auto film = pixels_of({{"KHR_materials_iridescence", {{"iridescenceFactor", 1.0}}}});
    const auto mixed = pixels_of(
        {{"KHR_materials_iridescence", {{"iridescenceFactor", 0.5}, {"iridescenceTexture", {{"index", 0}}}}}});
    expect_at(mixed, -0.5F, glm::dvec3(at(plain, -0.5F, 0.0F)));
    expect_at(mixed, 0.5F, 0.5 * glm::dvec3(at(plain, 0.5F, 0.0F) + at(film, 0.5F, 0.0F)));
}

TEST_F(GltfFilm, ThatBlendsTintsTheLightBehindByWhatItDoesNotReflect) {
    register_module(renderer_);
    const auto pixels =
        pixels_of({{"KHR_materials_ior", {{"ior", 1.0}}},
                   {"KHR_materials_iridescence",
                    {{"iridescenceFactor", 1.0}, {"iridescenceIor", 1.8}, {"iridescenceThicknessMaximum", 210.0}}}},
                  scene::AlphaMode::Blend);
    const glm::dvec3 reflected = exact(1.8, 210.0, 1.0, 0.2F);
    EXPECT_GT(std::abs(reflected.r - reflected.b), 0.1);
    // The background is white, like the light: what is not reflected comes from behind, channel by channel.
    expect_at(pixels, 0.2F, glm::dvec3(1.0));
}

TEST_F(GltfFilm, OfFactorZeroIsThePlainSurface) {
    const auto plain = pixels_of(nlohmann::json::object());
    register_module(renderer_);
    EXPECT_EQ(pixels_of({{"KHR_materials_iridescence", {{"iridescenceIor", 1.8}}}}), plain);
}

TEST_F(GltfFilm, ANamedMetalIsTheBase) {
    register_module(renderer_);
    const auto pixels = pixels_of(
        {{"KHR_materials_iridescence",
          {{"iridescenceFactor", 1.0}, {"iridescenceThicknessMaximum", 0.0}, {"extras", {{"metal", "Ag"}}}}}});
    EXPECT_GT(at(pixels, 0.0F, 0.0F).g, 0.9F);
}

TEST_F(GltfFilm, ATextureThatIsNotThereIsRefusedWithItsPlace) {
    register_module(renderer_);
    const std::string message = rowland::test::message_of([&] {
        pixels_of(
            {{"KHR_materials_iridescence", {{"iridescenceFactor", 1.0}, {"iridescenceTexture", {{"index", 7}}}}}});
    });
    for (const char* part : {"scene.gltf", "/materials/0/extensions/KHR_materials_iridescence/iridescenceTexture/index",
                             "7", "1 textures"})
        EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace
}  // namespace rowland::thin_film
