#include "modules/asset_types.h"

#include "engine/module.h"
#include "modules/diffraction/cook.h"

namespace rowland::modules {

std::shared_ptr<const cook::Registry> asset_types() {
    return make_registry({diffraction::register_module});
}

}  // namespace rowland::modules
