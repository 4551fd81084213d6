#include "editor/cooker/cooker_program.h"
#include "editor/cooker/export_command.h"
#include "modules/asset_types.h"

int main(int argc, char** argv) {
    return rowland::editor::run_cooker(argc, argv, *rowland::modules::asset_types(),
                                       {rowland::editor::add_export_command});
}
