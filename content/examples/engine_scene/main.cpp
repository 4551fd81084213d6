// engine_scene SCENE PROBE PICTURE: a glTF scene, drawn by Rowland's engine. Materials with the extension
// ROWLAND_materials_diffraction are gratings.
#include <modules/diffraction/module.h>

#include "draw_scene.h"

int main(int argc, char** argv) {
    return draw_scene(argc, argv, [](rowland::render::Renderer& renderer) {
        rowland::diffraction::register_module(renderer, {.slices_per_frame = 1000});  // whole maps at once
    });
}
