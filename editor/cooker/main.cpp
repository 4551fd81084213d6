#include "editor/cooker/cooker_program.h"
#include "modules/asset_types.h"

int main(int argc, char** argv) {
    return rowland::editor::run_cooker(argc, argv, *rowland::modules::asset_types());
}
