// What remains of a damaged file that is read can be drawn: the driver reports no error, and nothing ends the program.

#include <algorithm>

#include "engine/core/error.h"
#include "engine/image/exr.h"
#include "engine/render/scene_instance.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/material_types.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/runtime/film_surface.h"
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/seeds.h"
#include "tests/gpu/render_test.h"

namespace rowland::fuzz {
namespace {

using Bytes = std::span<const std::byte>;

class DrawnFile : public test::RenderTest {
 protected:
    DrawnFile() {
        modules::register_material_types(renderer_);
        set_sun({0.3F, 0.4F, 1.0F});
        square_ = add(square(), {});
    }

    /// Draws ROWLAND_MUTATIONS damaged files of a format, 40 unless it is set.
    void draw_mutations(const char* name, const std::function<void(Bytes)>& draw_file) {
        std::vector<Seed> sound;
        for (Seed& seed : seeds(format(name)))
            if (accepts(format(name), seed.bytes)) sound.push_back(std::move(seed));
        ASSERT_FALSE(sound.empty());
        const auto size = [](const Seed& seed) { return seed.bytes.size(); };
        const std::size_t most = std::max(kLargestSeed, size(std::ranges::min(sound, {}, size)));
        std::erase_if(sound, [&](const Seed& seed) { return size(seed) > most; });
        const char* asked = std::getenv("ROWLAND_MUTATIONS");
        const int count = asked != nullptr ? std::atoi(asked) : 40;
        int drawn = 0;
        for (int i = 0; i < count; ++i) {
            const Seed& seed = sound[static_cast<std::size_t>(i) % sound.size()];
            SCOPED_TRACE(seed.name + " mutated as " + std::to_string(i));
            try {
                draw_file(mutate(seed.bytes, static_cast<std::uint64_t>(i)));
                ++drawn;
            } catch (const Error& error) {
                EXPECT_EQ(error.info().fault, Fault::Input) << error.what();
            }
        }
        std::printf("%s: %d mutations, %d of them drawn\n", name, count, drawn);
        EXPECT_GT(drawn, 0);
    }

    void draw_scene(Bytes file) {
        const scene::ImportedScene imported = scene::load_glb(file, "input.glb", renderer_.gltf_extensions());
        const scene::Bounds box = scene::bounds(scene::merge_instances(imported));
        const render::SceneInstance instance = render::instantiate(world_, imported, renderer_, "input.glb");
        for (std::size_t i = 0; i < instance.animations.size(); ++i) instance.animate(world_, i, 0.5F);
        scene::update_world_matrices(world_);
        const glm::vec3 middle = 0.5F * (box.minimum + box.maximum);
        camera_.target = middle;
        const float size = glm::max(glm::length(box.maximum - box.minimum), 0.01F);
        camera_.eye = middle + glm::vec3(0.0F, 0.0F, 2.0F * size);
        camera_.near_plane = 0.1F * size;
        camera_.far_plane = 10.0F * size;
        draw();
        render::destroy(world_, instance);
    }
    void draw_under(const image::Image& image) {
        lighting::LightProbeSettings settings;
        settings.bands = 3;
        settings.key_lights = 0;
        settings.light_face = 8;
        settings.prefilter.face_size = 16;
        renderer_.set_probe(
            lighting::build_light_probe({image, lighting::Mapping::Equirectangular, "input"}, settings));
        draw();
    }

    static constexpr std::size_t kLargestSeed = std::size_t{64} << 10;
    const glm::dmat3 xyz_to_working_ = glm::inverse(colour::rec709_to_xyz());
    ecs::Entity square_;
};

TEST_F(DrawnFile, Scenes) {
    draw_mutations("glb", [&](Bytes file) { draw_scene(file); });
}

TEST_F(DrawnFile, GltfDocuments) {
    draw_mutations("gltf", [&](Bytes file) {
        draw_scene(scene::glb_beginning({reinterpret_cast<const char*>(file.data()), file.size()}, std::nullopt, 0,
                                        "input.glb"));
    });
}

TEST_F(DrawnFile, CookedGratings) {
    draw_mutations("cooked-material", [&](Bytes file) {
        const diffraction::CookedMaterial cooked = diffraction::read_cooked_material(file, "input.material");
        diffraction::add_surface(world_, square_, {.material = diffraction::make_gpu_material(cooked, xyz_to_working_)},
                                 true);
        draw();
    });
}

TEST_F(DrawnFile, CookedFilms) {
    draw_mutations("cooked-film", [&](Bytes file) {
        thin_film::add_film(world_, square_, thin_film::read_cooked_film(file, "input.film"), xyz_to_working_);
        draw();
    });
}

TEST_F(DrawnFile, Probes) {
    draw_mutations("cooked-probe", [&](Bytes file) {
        renderer_.set_probe(lighting::deserialise(file, "input.probe"));
        draw();
    });
    draw_mutations("hdr", [&](Bytes file) { draw_under(image::read_radiance_hdr(file, "input.hdr")); });
    draw_mutations("exr", [&](Bytes file) { draw_under(image::read_exr(file, "input.exr")); });
}

}  // namespace
}  // namespace rowland::fuzz
