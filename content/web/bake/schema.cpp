// The schema of foil recipes, which `rowland-cook schema foil` prints, for the page's build.
#include "engine/core/json_schema.h"

#include "content/web/bake/exports.h"
#include "modules/diffraction/foil/recipe.h"

namespace rowland::web {

/// Its text, a number for each character.
ROWLAND_EXPORT(foil_schema) Numbers* foil_schema() {
    const auto parse = [](JsonReader& json) { diffraction::foil::parse_foil_recipe(json); };
    const std::string text = json_schema("Rowland foil recipe", parse).dump(-1, ' ', true);
    return new Numbers(text.begin(), text.end());
}

}  // namespace rowland::web
