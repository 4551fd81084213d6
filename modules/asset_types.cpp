#include "modules/asset_types.h"

#include "engine/module.h"
#include "modules/diffraction/cook.h"
#include "modules/thin_film/cook.h"

namespace rowland::modules {

std::shared_ptr<const cook::Registry> asset_types() {
    return make_registry({diffraction::register_module, thin_film::register_module});
}

}  // namespace rowland::modules
