#pragma once

namespace CLI {
class App;
}

namespace rowland::editor {

/// Adds `export`, which writes a diffraction material, and on request a probe and a map, for programs in any language:
/// modules/diffraction/portable.
void add_export_command(CLI::App& program);

}  // namespace rowland::editor
