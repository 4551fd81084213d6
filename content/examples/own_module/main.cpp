// own_module SCENE PROBE PICTURE: draws a glTF scene with Rowland's engine and a module of this project. Materials with
// the extension EXAMPLE_materials_metal are metals with the complex refractive index given there.
#include <engine/module.h>

#include "draw_scene.h"
#include "metal_surface.h"

int main(int argc, char** argv) {
    const auto registry = rowland::make_registry({metal::register_module});
    return draw_scene(argc, argv, *registry,
                      [](rowland::render::Renderer& renderer) { metal::register_module(renderer); });
}
