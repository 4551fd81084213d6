#include "engine/render/material.h"

#include <nlohmann/json.hpp>

#include "engine/core/check.h"

namespace rowland::render {

void MaterialType::attach(ecs::World& /*world*/, ecs::Entity /*entity*/, const nlohmann::json& /*extension*/,
                          SurfaceTextures& /*textures*/, const std::string& /*file*/, const std::string& place) {
    ROWLAND_CHECK(false, "attach() on a material type without a glTF extension, for " + place);
}

}  // namespace rowland::render
