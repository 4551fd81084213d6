#include "draw_scene.h"

#include <engine/image/image.h>
#include <engine/live/live_assets.h>
#include <engine/platform/gl_context.h>
#include <engine/post/ocio_config.h>
#include <engine/render/scene_instance.h>
#include <engine/scene/transform.h>
#include <engine/view/picture.h>

#include <cstdio>
#include <exception>
#include <stdexcept>

using namespace rowland;

namespace {

scene::Camera first_camera(const scene::ImportedScene& scene) {
    if (scene.cameras.empty()) throw std::runtime_error("the scene has no camera");
    const scene::ImportedCamera& camera = scene.cameras.front();
    const glm::mat4& world = scene.nodes[camera.node].world;
    const glm::vec3 eye(world[3]);
    return {.eye = eye,
            .target = eye - glm::vec3(world[2]),
            .up = glm::vec3(world[1]),
            .vertical_field_of_view = camera.vertical_field_of_view,
            .near_plane = camera.near_plane};
}

}  // namespace

int draw_scene(int argc, char** argv, const cook::Registry& registry,
               const std::function<void(render::Renderer&)>& register_modules) try {
    if (argc != 4) return std::fprintf(stderr, "usage: %s SCENE PROBE PICTURE\n", argv[0]), 2;
    const platform::HeadlessContext context;

    view::Picture picture(post::OcioConfig::choose(), "", {960, 540});
    register_modules(picture.renderer());
    const lighting::ProbeImage probe(image::load_image(argv[2]), lighting::Mapping::Equirectangular, argv[2]);
    picture.set_probe(lighting::build_light_probe(probe));

    // A glTF file is cooked first and cached; a .scene is loaded directly.
    std::vector<std::filesystem::path> read_files;
    const scene::ImportedScene scene = live::load_scene(registry, argv[1], live::default_cache_folder(), read_files);
    ecs::World world;
    render::instantiate(world, scene, picture.renderer(), argv[1]);
    scene::update_world_matrices(world);

    const scene::Camera camera = first_camera(scene);
    for (int frame = 0; frame < 2; ++frame)
        picture.draw(world, camera, 0.0F);  // maps are filled in full once objects rest: in the second frame
    view::write_display_capture(picture.encoded(), argv[3]);
    return 0;
} catch (const std::exception& error) {
    return std::fprintf(stderr, "error: %s\n", error.what()), 2;
}
