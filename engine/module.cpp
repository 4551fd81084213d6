#include "engine/module.h"

#include "engine/lighting/cook.h"
#include "engine/scene/cook.h"

namespace rowland {

std::shared_ptr<const cook::Registry> make_registry(std::initializer_list<RegisterAssets> modules) {
    auto registry = std::make_shared<cook::Registry>();
    for (const RegisterAssets register_module : modules) register_module(*registry);
    lighting::register_cook_types(*registry);
    scene::register_cook_types(*registry);
    return registry;
}

}  // namespace rowland
