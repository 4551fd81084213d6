// Surfaces under the probes of boxes: alone, between two, and on the way from one to the other.
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "engine/scene/mesh_recipe.h"
#include "engine/scene/ray.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

/// Of a wall of a room of the size of `half`, toward which a point or a direction from its middle lies: grey.
float wall_of(const glm::dvec3& toward, const glm::dvec3& half) {
    const glm::dvec3 at = glm::abs(toward) / half;
    const int axis = at.x > at.y ? (at.x > at.z ? 0 : 2) : (at.y > at.z ? 1 : 2);
    return 0.2F + 0.15F * static_cast<float>(2 * axis + (toward[axis] > 0.0 ? 1 : 0));
}

/// The room as its middle sees it, with a lamp.
lighting::ProbeImage room(const glm::dvec3& half, const glm::vec3& tint) {
    constexpr int kRows = 64;
    image::Image picture{.width = 2 * kRows, .height = kRows, .texels = {}};
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 2 * kRows; ++column) {
            const double theta = std::numbers::pi * (row + 0.5) / kRows;
            const double phi = std::numbers::pi * ((column + 0.5) / kRows - 1.0);
            const glm::dvec3 s(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            const bool lamp = glm::dot(s, glm::normalize(glm::dvec3(0.3, 0.9, 0.4))) > 0.99;
            picture.texels.push_back(tint * (lamp ? 30.0F : wall_of(s, half)));
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

/// Built once for all tests.
std::shared_ptr<const lighting::LightProbe> probe_of(const glm::vec3& tint, const glm::dvec3& half = glm::dvec3(1.0)) {
    static std::map<std::array<double, 6>, std::shared_ptr<const lighting::LightProbe>> built;
    auto& probe = built[{tint.r, tint.g, tint.b, half.x, half.y, half.z}];
    if (!probe)
        probe = std::make_shared<const lighting::LightProbe>(lighting::build_light_probe(
            room(half, tint), {.bands = 8, .key_lights = 4, .light_face = 32, .prefilter = {.face_size = 64}}));
    return probe;
}

const glm::vec3 kWarm(1.0F, 0.7F, 0.3F);
const glm::vec3 kCold(0.2F, 0.5F, 1.0F);
const glm::vec3 kSky(0.1F, 0.9F, 0.2F);

/// One object in front of the camera.
class LocalProbe : public test::GlTest {
 protected:
    explicit LocalProbe(MapPace pace = MapPace::Whole) {
        register_module(renderer_, {.map_pace = pace});
        renderer_.set_probe(*probe_of(kSky));
        renderer_.use_key_lights(true);
        object_ = world_.create();
        world_.add(object_, scene::Transform{});
        show(scene::build_mesh(scene::SphereRecipe{.radius = 1.0}));
        world_.add(object_, render::StandardMaterial{.base_colour = {0.7F, 0.5F, 0.3F}, .roughness = 0.4F});
    }

    void show(scene::Mesh mesh) { world_.add(object_, render::make_mesh_instance(std::move(mesh))); }
    void use(const CookedMaterial& cooked) {
        const auto material = make_gpu_material(cooked, glm::dmat3(1.0));
        world_.add(object_, render::StandardMaterial(material->base()));
        world_.add(object_, DiffractionSurface{material});
    }
    /// A box so large that directions do not depend on where in it they begin.
    ecs::Entity add_box(const std::shared_ptr<const lighting::LightProbe>& probe, const glm::vec3& centre = {},
                        const glm::vec3& half = glm::vec3(1e4F), float fade_m = 1.0F) {
        const ecs::Entity entity = world_.create();
        world_.add(entity, scene::Transform{.translation = centre});
        world_.add(entity, render::ProbeVolume{.probe = probe, .half = half, .fade_m = fade_m});
        return entity;
    }
    std::vector<glm::vec4> draw() {
        scene::update_world_matrices(world_);
        renderer_.render(world_, camera_, target_);
        return target_.read_rgba_float();
    }
    /// The picture under the renderer's own probe.
    std::vector<glm::vec4> draw_under(const glm::vec3& tint) {
        renderer_.set_probe(*probe_of(tint));
        std::vector<glm::vec4> pixels = draw();
        renderer_.set_probe(*probe_of(kSky));
        return pixels;
    }
    /// Largest difference over the pixels that show the object, over the largest component.
    double difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) const {
        double largest = 0.0;
        double brightest = 0.0;
        for (int row = 0; row < kSize; ++row)
            for (int column = 0; column < kSize; ++column) {
                const glm::dvec2 from_middle = (glm::dvec2(column, row) + 0.5) / (0.5 * kSize) - 1.0;
                if (glm::length(from_middle) > kObject) continue;
                const auto i = static_cast<std::size_t>(row * kSize + column);
                for (int c = 0; c < 3; ++c) {
                    const double change = static_cast<double>(std::abs(a[i][c] - b[i][c]));
                    largest = std::isfinite(change) ? std::max(largest, change) : 1e30;
                    brightest = std::max(brightest, static_cast<double>(std::abs(a[i][c])));
                }
            }
        return largest / brightest;
    }
    static std::vector<glm::vec4> mixed(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b, float part) {
        std::vector<glm::vec4> result;
        for (std::size_t i = 0; i < a.size(); ++i) result.push_back(glm::mix(a[i], b[i], part));
        return result;
    }
    /// Alone in a box it looks as under the renderer's probe; a quarter of a metre outside it has three quarters of
    /// what it would have of the box, and one of the sky.
    void expect_mix(double tolerance = 2e-3) {
        const std::vector<glm::vec4> sky = draw();
        const ecs::Entity box = add_box(probe_of(kWarm));
        const std::vector<glm::vec4> inside = draw();
        EXPECT_GT(difference(sky, inside), 0.1);
        world_.get<scene::Transform>(box).translation.x = 1e4F + 0.25F;
        world_.get<render::ProbeVolume>(box).fade_m = 1e7F;
        const std::vector<glm::vec4> whole = draw();
        world_.get<render::ProbeVolume>(box).fade_m = 1.0F;
        const std::vector<glm::vec4> between = draw();
        EXPECT_LT(difference(mixed(sky, whole, 0.75F), between), tolerance);
        for (const glm::vec4& pixel : between) ASSERT_EQ(pixel.a, 1.0F);
        world_.destroy(box);
        EXPECT_LT(difference(sky, draw()), 1e-6);
        if (world_.get<render::StandardMaterial>(object_).alpha_mode == scene::AlphaMode::Opaque &&
            !world_.get<render::StandardMaterial>(object_).passes_light) {
            EXPECT_LT(difference(draw_under(kWarm), inside), tolerance);
        }
    }

    static constexpr int kSize = 48;
    static constexpr double kObject = 0.6;  ///< radius of what surely shows the object, of half the picture

    render::Renderer renderer_{glm::dmat3(1.0)};
    ecs::World world_;
    ecs::Entity object_;
    scene::Camera camera_{.eye = {0.0F, 0.0F, 3.0F}};
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true}};
};

TEST_F(LocalProbe, LightsAPlainSurface) {
    expect_mix();
}

TEST_F(LocalProbe, LightsWhatBlends) {
    world_.add(object_, render::StandardMaterial{
                            .base_colour = {0.7F, 0.5F, 0.3F}, .alpha = 0.6F, .alpha_mode = scene::AlphaMode::Blend});
    expect_mix();
}

TEST_F(LocalProbe, LightsEveryRepresentation) {
    for (const char* quality :
         {R"({"representation": "spikes"})", R"({"representation": "arc", "key_lights": 4})",
          R"({"representation": "circle", "map_resolution": 32, "key_lights": 4})", R"({"representation": "direct"})",
          R"({"representation": "planar", "map_resolution": 48, "key_lights": 4})"}) {
        SCOPED_TRACE(quality);
        if (std::string_view(quality).find("planar") != std::string_view::npos) {
            show(scene::build_mesh(scene::PlaneRecipe{.width = 2.0, .depth = 2.0}));
            world_.get<scene::Transform>(object_).rotation = glm::angleAxis(1.0F, glm::vec3(1.0F, 0.0F, 0.0F));
        }
        use(cook(kSlitCd, quality));
        expect_mix(1e-2);  // a curved mirror's level follows from differences of directions
    }
}

TEST_F(LocalProbe, LightsBothSidesOfASheet) {
    use(cook_complete(kSlitCd, R"({"representation": "arc", "bands": 4, "rank": 8})",
                      R"(, "transmission": {"ior": 1.5})"));
    expect_mix();
}

/// A mirror shows of the room what its rays meet, not what lies in the same direction from the room's middle.
TEST_F(LocalProbe, AMirrorShowsTheWallsWhereItsRaysMeetThem) {
    const glm::dvec3 half(3.0, 2.0, 2.5);
    add_box(probe_of(glm::vec3(1.0F), half), {}, glm::vec3(half));
    world_.add(object_, render::StandardMaterial{.base_colour = glm::vec3(1.0F), .metallic = 1.0F, .roughness = 0.0F});
    const glm::vec3 centre(1.7F, -0.6F, -0.8F);
    world_.get<scene::Transform>(object_).translation = centre;
    camera_.eye = centre + glm::vec3(-1.0F, 0.8F, 3.0F);
    camera_.target = centre;
    const std::vector<glm::vec4> drawn = draw();
    int compared = 0;
    int wrong = 0;
    int moved = 0;
    for (int row = 0; row < kSize; ++row)
        for (int column = 0; column < kSize; ++column) {
            const scene::Ray ray = scene::ray_through(camera_, glm::dvec2(column, row) + 0.5, glm::dvec2(kSize));
            const glm::dvec3 from = glm::dvec3(ray.origin) - glm::dvec3(centre);
            const glm::dvec3 along(ray.direction);
            const double middle = glm::dot(from, along);
            const double under = middle * middle - glm::dot(from, from) + 1.0;
            if (under < 0.2) continue;  // beside the sphere or at its outline
            const glm::dvec3 normal = from - (middle + std::sqrt(under)) * along;
            const glm::dvec3 point = glm::dvec3(centre) + normal;
            const glm::dvec3 mirrored = glm::reflect(along, normal);
            const glm::dvec3 steps = (half * glm::sign(mirrored) - point) / mirrored;
            const glm::dvec3 met = point + std::min({steps.x, steps.y, steps.z}) * mirrored;
            const float expected = wall_of(met, half);
            const double shown = static_cast<double>(drawn[static_cast<std::size_t>(row * kSize + column)].y);
            ++compared;
            wrong += std::abs(shown - static_cast<double>(expected)) > 0.03 ? 1 : 0;
            moved += expected != wall_of(mirrored, half) ? 1 : 0;
        }
    EXPECT_GT(compared, 300);
    EXPECT_GT(moved, compared / 5);       // as from the middle it would be another wall
    EXPECT_LT(wrong, compared * 2 / 10);  // along the edges and at the lamp
}

/// Through a door, while maps are filled behind the frames.
class Door : public LocalProbe {
 protected:
    Door() : LocalProbe(MapPace::Incremental) {
        world_.add(object_, scene::Transform{});
        camera_.eye.z = 5.0F;
        use(cook(kSlitCd, R"({"representation": "circle", "map_resolution": 32, "key_lights": 4})"));
    }
    /// The largest change of a component from one frame of a walk to the next.
    float largest_step() {
        float largest = 0.0F;
        std::vector<glm::vec4> before;
        for (int frame = 0; frame <= kFrames; ++frame) {
            const float along = 2.0F * static_cast<float>(frame) / kFrames - 1.0F;
            world_.get<scene::Transform>(object_).translation.x = kReach * along;
            std::vector<glm::vec4> shown = draw();
            for (int wait = 0; frame == 0 && maps_are_filling(world_) && wait < 10000; ++wait) shown = draw();
            for (std::size_t i = 0; i < before.size(); ++i)
                for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(shown[i][c] - before[i][c]));
            before = std::move(shown);
        }
        return largest;
    }

    static constexpr int kFrames = 200;
    static constexpr float kReach = 1.5F;
};

TEST_F(Door, AnObjectOnItsWayThroughChangesAsLittleAsInOneRoom) {
    const auto warm = probe_of(kWarm);
    const auto cold = probe_of(kCold);
    const std::array centres = {glm::vec3(-20.0F, 0.0F, 0.0F), glm::vec3(19.0F, 0.0F, 0.0F)};
    const std::array halves = {glm::vec3(20.0F), glm::vec3(19.0F)};
    float in_one_room = 0.0F;
    for (const auto& probe : {warm, cold}) {
        const std::array rooms = {add_box(probe, centres[0], halves[0]), add_box(probe, centres[1], halves[1])};
        in_one_room = std::max(in_one_room, largest_step());
        for (const ecs::Entity room : rooms) world_.destroy(room);
    }
    add_box(warm, centres[0], halves[0]);
    add_box(cold, centres[1], halves[1]);
    const float through_the_door = largest_step();
    RecordProperty("ratio", std::to_string(through_the_door / in_one_room));
    EXPECT_GT(in_one_room, 0.0F);
    EXPECT_LE(through_the_door, 1.1F * in_one_room);
}

}  // namespace
}  // namespace rowland::diffraction
