// engine_scene SCENE PROBE PICTURE: a glTF scene, drawn by Rowland's engine. Materials with the extension
// ROWLAND_materials_diffraction are gratings.
#include <modules/diffraction/module.h>

#include "draw_scene.h"

int main(int argc, char** argv) {
    return draw_scene(argc, argv, [](rowland::render::Renderer& renderer) {
        using namespace rowland::diffraction;
        register_module(renderer, {.map_pace = MapPace::Whole});
    });
}
