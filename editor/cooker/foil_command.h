#pragma once

namespace CLI {
class App;
}

namespace rowland::editor {

/// Adds `foil`, which makes a card with foil from an artist's recipe: modules/diffraction/foil.
void add_foil_command(CLI::App& program);

}  // namespace rowland::editor
