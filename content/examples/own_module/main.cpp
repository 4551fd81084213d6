// own_module SCENE PROBE PICTURE: a glTF scene, drawn by Rowland's engine with a module of this project. Materials with
// the extension EXAMPLE_materials_metal are metals of that complex index of refraction.
#include <engine/module.h>

#include "draw_scene.h"
#include "metal_surface.h"

int main(int argc, char** argv) {
    const auto registry = rowland::make_registry({metal::register_module});
    return draw_scene(argc, argv, *registry,
                      [](rowland::render::Renderer& renderer) { metal::register_module(renderer); });
}
