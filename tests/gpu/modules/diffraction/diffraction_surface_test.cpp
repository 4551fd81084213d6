// What all representations have in common: one component, whatever shades it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

using ::testing::HasSubstr;

class Surface : public GratingPicture {};

TEST_F(Surface, AnEntityKeepsItsPlaceWhenItsRepresentationChanges) {
    const char* const qualities[] = {
        R"({"representation": "spikes"})", R"({"representation": "planar", "map_resolution": 32})",
        R"({"representation": "arc"})", R"({"representation": "circle", "map_resolution": 24})"};
    mesh_ = flat_triangle();
    show(cook(kSlitCd, qualities[0]));
    const ecs::Entity entity = entity_;
    std::vector<std::vector<glm::vec4>> pictures;
    for (const char* quality : qualities) {
        use(cook(kSlitCd, quality));
        pictures.push_back(draw());
    }
    EXPECT_TRUE(world_.alive(entity));
    // And back again: nothing is left of what was between.
    use(cook(kSlitCd, qualities[0]));
    EXPECT_EQ(draw(), pictures[0]);
    // All show the same grating under the same smooth light: to the 10 % of four spikes, the coarsest.
    for (std::size_t i = 1; i < pictures.size(); ++i) {
        double difference = 0.0;
        double size = 0.0;
        for (std::size_t pixel = 0; pixel < pictures[i].size(); ++pixel) {
            const glm::dvec3 reference(pictures[2][pixel]);
            const glm::dvec3 d = glm::dvec3(pictures[i][pixel]) - reference;
            difference += glm::dot(d, d);
            size += glm::dot(reference, reference);
        }
        EXPECT_GT(size, 0.1);
        EXPECT_LT(std::sqrt(difference / size), 0.1) << qualities[i];
    }
}

TEST_F(Surface, ATurnOfTheGroovesIsATurnOfTheTangents) {
    mesh_ = flat_triangle();
    show(cook(kBlazed, R"({"representation": "arc"})"), 0.6);
    const std::vector<glm::vec4> turned = draw();
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 g(mesh_.tangents[i]);
        const glm::vec3 bitangent = mesh_.tangents[i].w * glm::cross(mesh_.normals[i], g);
        mesh_.tangents[i] = glm::vec4(std::cos(0.6F) * g + std::sin(0.6F) * bitangent, mesh_.tangents[i].w);
    }
    world_.add(entity_, render::make_mesh_instance(scene::Mesh(mesh_)));
    world_.add(entity_, DiffractionSurface{material_, 0.0F});
    EXPECT_LT(largest_difference(turned, [&](const Point&) { return glm::dvec3(1.0); }), 1e3);  // counts pixels
    const std::vector<glm::vec4> plain = draw();
    float largest = 0.0F;
    float difference = 0.0F;
    for (std::size_t i = 0; i < plain.size(); ++i)
        for (int o = 0; o < 3; ++o) {
            largest = std::max(largest, std::abs(plain[i][o]));
            difference = std::max(difference, std::abs(plain[i][o] - turned[i][o]));
        }
    EXPECT_GT(largest, 0.01F);
    EXPECT_LT(difference, 1e-4F * largest);  // float, turned before or after the vertices' interpolation
}

/// Under light from everywhere grease shows what all orders reflect, wherever they go.
TEST_F(Surface, GreaseScattersWhatTheGratingReflects) {
    mesh_ = flat_triangle();
    mesh_.uvs.assign(3, glm::vec2(0.0F));
    const CookedMaterial cooked = cook(kSlitCd, R"({"representation": "arc"})");
    show(cooked);
    render::StandardMaterial surface = material_->base();
    surface.base_colour = glm::vec3(0.0F);
    const auto map = std::make_shared<gpu::Texture>(gpu::TextureDesc{});
    map->upload(std::span<const glm::vec4>(std::array{glm::vec4(0.0F, 1.0F, glm::vec2(128.0F / 255.0F))}));
    surface.wear_texture = {.texture = map, .uv_set = 0, .transform = {}};
    world_.add(entity_, std::move(surface));
    const glm::dvec3 reflected = layer_weights(cooked.material.grating).reflected;
    const std::size_t middle = DrawnTriangle::kSize * DrawnTriangle::kSize / 2 + DrawnTriangle::kSize / 2;
    EXPECT_GT(reflected.y, 0.4);
    for (const double light : {0.25, 1.0}) {
        lighting::LightProbe probe = *light_.probe;
        probe.environment.layout = {.face_size = 4, .levels = 1};
        probe.environment.scale = static_cast<float>(light);
        probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0x3C00);
        renderer_->set_probe(std::move(probe));
        // A dielectric base adds 4 % of what reaches it.
        EXPECT_NEAR(draw()[middle].y, (reflected.y + 0.04 * (1.0 - reflected.y)) * light, 0.01 * light) << light;
    }
}

TEST_F(Surface, ViewsFromBelowAreBlack) {
    light_ = light_of(smooth_probe(), three_keys());
    mesh_ = flat_triangle();
    transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    show(cook(kSlitCd, R"({"representation": "direct"})"));
    for (const char* quality : {R"({"representation": "direct"})", R"({"representation": "arc"})",
                                R"({"representation": "planar", "map_resolution": 32})",
                                R"({"representation": "circle", "map_resolution": 24})"}) {
        use(cook(kSlitCd, quality));
        render::StandardMaterial both_sides = material_->base();
        both_sides.double_sided = true;  // the back is drawn as well
        world_.add(entity_, render::StandardMaterial(both_sides));
        const auto brightest = [&](float eye_z) {
            camera_.eye = {0.4F, 0.5F, eye_z};
            float largest = 0.0F;
            for (const glm::vec4& pixel : draw()) largest = std::max({largest, pixel.x, pixel.y, pixel.z});
            return largest;
        };
        EXPECT_GT(brightest(2.5F), 0.01F) << quality;
        EXPECT_EQ(brightest(-2.5F), 0.0F) << quality;
    }
}

TEST_F(Surface, VertexLightIsMadeOnlyWhenSomethingSeenChanges) {
    show(cook(kSlitCd, R"({"representation": "arc"})"));
    const auto made = [&] {
        draw();
        return world_.get<SurfaceState>(entity_).vertex_light.writes();
    };
    const int first = made();
    EXPECT_EQ(made(), first);
    camera_.eye.x += 0.5F;
    transform_.translation.x += 0.1F;  // a distant light does not see it
    EXPECT_EQ(made(), first);
    transform_.rotation = glm::angleAxis(0.1F, glm::vec3(1.0F, 0.0F, 0.0F));
    const int turned = made();
    EXPECT_NE(turned, first);
    ++light_.version;
    const int under_new_light = made();
    EXPECT_NE(under_new_light, turned);
    // What is not in the picture is updated when it is again.
    const glm::vec3 target = camera_.target;
    camera_.target = 2.0F * camera_.eye - target;
    transform_.rotation = glm::angleAxis(0.2F, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(made(), under_new_light);
    EXPECT_EQ(renderer_->report().culled, 1);
    camera_.target = target;
    EXPECT_NE(made(), under_new_light);
}

/// Gives the entity what a cooked scene's material holds.
class Attached : public Surface {
 protected:
    Attached() { show(cook(kSlitCd, R"({"representation": "direct"})")); }

    void attach(const std::string& members, const char* profile = kSlitCd) {
        const nlohmann::json object = parse_json(
            std::string("{\"grating\": ") + profile + R"(, "quality": {"representation": "direct"})" + members + "}",
            "m.gltf");
        const nlohmann::json material = material_members(object);
        scene::MaterialDescription description;
        description.tables[kGltfExtension] = std::make_shared<const std::vector<std::byte>>(
            write_gltf_tables(material, bake_material(parse_material(material, "m.gltf")), {}));
        type_.attach(world_, entity_, {object, description, file_, "/materials/0"}, textures_);
    }

    std::string file_ = "m.gltf";
    DiffractionSurfaceType type_{glm::dmat3(1.0)};
    scene::ImportedScene no_pictures_;
    render::SurfaceTextures textures_{no_pictures_};
};

TEST_F(Attached, LiesOnTheSurfaceAsTheExtensionSays) {
    attach(R"(, "grooveRotation": 0.25)");
    EXPECT_EQ(world_.get<DiffractionSurface>(entity_).groove_rotation, 0.25F);
    EXPECT_THAT(rowland::test::message_of([&] { attach(R"(, "grooveTexture": {"index": 0})"); }),
                HasSubstr("/materials/0/grooveTexture/index"));
}

TEST_F(Attached, EqualTablesAreUploadedOnce) {
    attach("");
    const auto first = world_.get<DiffractionSurface>(entity_).material;
    attach(R"(, "metal": "Al")");
    EXPECT_NE(world_.get<DiffractionSurface>(entity_).material, first);
    attach("");
    EXPECT_EQ(world_.get<DiffractionSurface>(entity_).material, first);
}

/// A grating's gloss is its cover's, whatever the glTF's coat is.
TEST_F(Attached, AClearCoatBesideAGratingIsNotDrawnAndSaysSo) {
    for (const char* cover : {"", R"(, "cover": {"ior": 1.5})"}) {
        world_.add(entity_, render::StandardMaterial{.clear_coat = 0.5F});
        testing::internal::CaptureStderr();
        attach(cover);
        EXPECT_THAT(testing::internal::GetCapturedStderr(),
                    testing::AllOf(HasSubstr("m.gltf: /materials/0"), HasSubstr("clearcoat"), HasSubstr("cover")));
        EXPECT_EQ(world_.get<render::StandardMaterial>(entity_).clear_coat, 0.0F);
    }
}

}  // namespace
}  // namespace rowland::diffraction
