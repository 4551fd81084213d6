#include "editor/cooker/cooker_program.h"
#include "tests/unit/engine/cook/tile_type.h"

int main(int argc, char** argv) {
    rowland::cook::Registry registry;
    rowland::test::register_tile_types(registry);
    return rowland::editor::run_cooker(argc, argv, registry);
}
