#include "editor/cooker/cooker_program.h"
#include "engine/lighting/cook.h"
#include "engine/scene/cook.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/cook.h"

int main(int argc, char** argv) {
    rowland::cook::Registry registry;
    rowland::lighting::register_cook_types(registry);
    rowland::scene::register_cook_types(registry, {rowland::diffraction::kGltfExtension});
    rowland::diffraction::register_cook_types(registry);
    return rowland::editor::run_cooker(argc, argv, registry);
}
