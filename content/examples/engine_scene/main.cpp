// engine_scene SCENE PROBE PICTURE: a glTF scene, drawn by Rowland's engine. Materials with the extension
// ROWLAND_materials_diffraction are gratings, those with KHR_materials_iridescence thin films.
#include <engine/module.h>
#include <modules/diffraction/cook.h>
#include <modules/diffraction/module.h>
#include <modules/thin_film/cook.h>
#include <modules/thin_film/module.h>

#include "draw_scene.h"

int main(int argc, char** argv) {
    const auto registry =
        rowland::make_registry({rowland::diffraction::register_module, rowland::thin_film::register_module});
    return draw_scene(argc, argv, *registry, [](rowland::render::Renderer& renderer) {
        rowland::diffraction::register_module(renderer, {.map_pace = rowland::diffraction::MapPace::Whole});
        rowland::thin_film::register_module(renderer);
    });
}
