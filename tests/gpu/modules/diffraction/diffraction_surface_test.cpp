// What all representations have in common: one component, whatever shades it.
#include <gmock/gmock.h>

#include "engine/colour/colour_space.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/support/expect.h"
#include "tests/support/light.h"

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
        EXPECT_LT(std::sqrt(difference / size), 0.1) << qualities[i];
    }
}

/// Under light from everywhere grease shows what all orders reflect, wherever they go.
/// Programs are found by their keys: two of one key are one program, whatever else differs.
TEST_F(Surface, ProgramsAreToldApartByTheirKeys) {
    std::set<std::uint64_t> keys{0};
    for (const char* quality :
         {R"({"representation": "spikes"})", R"({"representation": "arc"})", R"({"representation": "direct"})",
          R"({"representation": "planar", "map_resolution": 32})",
          R"({"representation": "circle", "map_resolution": 24})",
          R"({"representation": "planar", "map_resolution": 32, "key_lights": 4})"}) {
        const auto material = make_gpu_material(cook(kSlitCd, quality), glm::dmat3(1.0));
        for (const bool flat : {false, true})
            for (const bool without_map : {false, true}) {
                SurfaceState state;
                if (flat) state.flat = glm::dvec3(0.0, 1.0, 0.0);
                state.without_map = without_map;
                EXPECT_TRUE(keys.insert(material->program_key(state)).second) << quality;
                SurfaceState other;
                if (flat) other.flat = glm::dvec3(1.0, 0.0, 0.0);
                other.without_map = without_map;
                other.orientation = glm::mat3(2.0F);
                other.tangent = glm::vec4(1.0F);
                other.groove_rotation = 1.0F;
                other.probe = 3;
                EXPECT_EQ(material->program_key(other), material->program_key(state));
                EXPECT_EQ(material->program(other).defines, material->program(state).defines);
            }
    }
}

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
        renderer_->set_probe(with_even_environment(*light_.probe, static_cast<float>(light)));
        // A dielectric base adds 4 % of what reaches it.
        EXPECT_NEAR(draw()[middle].y, (reflected.y + 0.04 * (1.0 - reflected.y)) * light, 0.01 * light) << light;
    }
}

TEST_F(Surface, ViewsFromBelowAreBlack) {
    light_ = light_of(smooth_probe(), three_keys());
    mesh_ = flat_triangle();
    transform_.rotation = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    for (const char* quality : {R"({"representation": "direct"})", R"({"representation": "arc"})",
                                R"({"representation": "planar", "map_resolution": 32})",
                                R"({"representation": "circle", "map_resolution": 24})"}) {
        SCOPED_TRACE(quality);
        show(cook(kSlitCd, quality));
        world_.get<render::StandardMaterial>(entity_).double_sided = true;  // the back is drawn as well
        camera_.eye = {0.4F, 0.5F, 2.5F};
        EXPECT_GT(brightest(draw()), 0.01F);
        camera_.eye.z = -2.5F;
        EXPECT_EQ(brightest(draw()), 0.0F);
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

class BaseLight : public GratingPicture {
 protected:
    /// A grating that no light reaches, on a base layer under ambient light alone.
    void show_under_ambient_light(bool double_sided) {
        light_ = black_light();
        cooked_ = cook(kSlitCd, R"({"representation": "arc", "key_lights": 0})");
        show(cooked_);
        lighting::LightProbe probe = with_even_environment({}, 0.0F);
        probe.ambient = ambient_;
        renderer_->set_probe(std::move(probe));
        world_.add(entity_, render::StandardMaterial{.base_colour = kColour, .double_sided = double_sided});
    }
    glm::dvec3 reflected(const glm::dvec3& normal) const {
        const glm::dmat3 to_xyz = colour::rec709_to_xyz();
        return layer_weights(cooked_.material.grating).base * (to_xyz * glm::dvec3(kColour)) *
               (to_xyz * rowland::test::evaluate_irradiance(ambient_, normal));
    }
    AtPoint of_each_pixel() const {
        return [this](const Point& point) { return reflected(glm::transpose(point.to_tangent)[2]); };
    }

    static constexpr glm::vec3 kColour{0.8F, 0.6F, 0.4F};
    CookedMaterial cooked_;
    lighting::AmbientLight ambient_{.coefficients = {glm::dvec3(3.0), glm::dvec3(0.3, 0.2, 0.1), glm::dvec3(0.2),
                                                     glm::dvec3(0.1), glm::dvec3(0.5, -0.5, 0.2), glm::dvec3(0.4),
                                                     glm::dvec3(1.0), glm::dvec3(-0.6, 0.1, 0.3), glm::dvec3(0.7)},
                                    .window = {}};
};

TEST_F(BaseLight, AmbientLightIsInterpolatedBetweenTheVertices) {
    show_under_ambient_light(false);
    std::vector<glm::dvec3> shaded;
    for (std::size_t vertex = 0; vertex < 3; ++vertex)
        shaded.push_back(reflected(glm::transpose(vertex_frame(vertex))[2]));
    expect_drawn([&](const Point& point) { return mix(point, shaded); }, nullptr, 1e-5);
    EXPECT_GT(largest_difference(draw(), of_each_pixel()), 1e-3);
}

TEST_F(BaseLight, OfADoubleSidedSurfaceIsThatOfEachPixel) {
    show_under_ambient_light(true);
    expect_drawn(of_each_pixel(), nullptr, 1e-5);
}

/// What a grating adds is XYZ in the working space, whichever that is.
class WorkingSpace : public GratingPicture {
 protected:
    WorkingSpace() { mesh_ = flat_triangle(); }
    std::vector<glm::vec4> drawn_in(const glm::dmat3& xyz_to_working, const CookedMaterial& cooked) {
        xyz_to_working_ = xyz_to_working;
        light_ = light_of(probe_, three_keys(), ++version_);
        world_ = ecs::World();
        show(cooked, 0.5);
        world_.add(entity_, render::StandardMaterial{.base_colour = glm::vec3(0.0F), .roughness = 1.0F});
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 0.2F, 0.9F)),
                                                            .irradiance = glm::vec3(0.5F, 0.3F, 0.2F)});
        return draw();
    }

    /// 3e-3: half floats, which are rounded in the space that they are in, by values that partly cancel.
    void expect_drawn_in(const glm::dmat3& working, const CookedMaterial& cooked) {
        std::vector<glm::vec4> expected = drawn_in(glm::dmat3(1.0), cooked);
        for (glm::vec4& pixel : expected) pixel = glm::vec4(working * glm::dvec3(pixel), 1.0);
        EXPECT_GT(brightest(expected), 0.01F);
        EXPECT_LT(largest_difference(expected, drawn_in(working, cooked)), 3e-3);
    }

    lighting::ProbeImage probe_ = smooth_probe();

 private:
    std::uint64_t version_ = 0;
};

TEST_F(WorkingSpace, EveryRepresentationDrawsInIt) {
    const glm::dmat3 working = glm::transpose(glm::dmat3(1.7, -0.4, -0.2, -0.6, 1.5, 0.1, 0.05, -0.2, 0.9));
    const char* const narrow = R"({"pitch_nm": 1300, "profile": {"type": "slit", "width_nm": 600},
                                   "groove_lobe": {"sigma": 0.1}})";
    const char* const zero_order =
        R"({"pitch_nm": 1601, "profile": {"type": "slit", "width_nm": 700}, "orders": [-1, 0, 1]})";
    const std::pair<const char*, const char*> materials[] = {
        {kSlitCd, R"({"representation": "spikes"})"},
        {kSlitCd, R"({"representation": "arc", "lights_at": "vertices"})"},
        {kSlitCd, R"({"representation": "planar", "map_resolution": 32})"},
        {kBlazed, R"({"representation": "circle", "map_resolution": 8})"},
        {narrow, R"({"representation": "streak", "map_resolution": 64})"},
        {kPits, R"({"representation": "direct"})"},
        {kPits, R"({"representation": "direct", "lights_at": "vertices"})"},
        {zero_order, R"({"representation": "direct"})"}};
    for (const auto& [grating, quality] : materials) {
        SCOPED_TRACE(std::string(grating) + quality);
        expect_drawn_in(working, cook(grating, quality));
    }
}

/// Such maps are sharpened as light that nowhere is negative, as some spectral colours are in a working space. Beside a
/// lamp they would have rings.
TEST_F(WorkingSpace, MapsOfLobesAndLatticesAroundALampDrawInIt) {
    image::Image room{.width = 64, .height = 32, .texels = {std::size_t{64} * 32, glm::vec3(0.1F)}};
    for (const int texel : {64 * 9 + 20, 64 * 11 + 40, 64 * 13 + 5})
        room.texels[static_cast<std::size_t>(texel)] = glm::vec3(60.0F);
    probe_ = {std::move(room), lighting::Mapping::Equirectangular};
    for (const char* grating : {R"({"pitch_nm": 900, "profile": {"type": "slit", "width_nm": 400},
                                    "groove_lobe": {"sigma": 0.05}})",
                                R"({"lattice": {"a_nm": [900, 0], "b_nm": [0, 1100]}, "orders": 1,
                                    "profile": {"type": "aperture", "width_nm": 400, "height_nm": 500}})"}) {
        SCOPED_TRACE(grating);
        expect_drawn_in(
            colour::xyz_to_acescg(),
            cook(grating, R"({"representation": "planar", "map_resolution": 32, "views_h": 32, "key_lights": 0})"));
    }
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
