#include "engine/render/material.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/scene/transform.h"

namespace rowland::render {

namespace {

/// For messages: the name of the nearest named node at or above an entity, else the entity's number.
std::string entity_name(ecs::World& world, ecs::Entity entity) {
    for (const ecs::Entity* at = &entity; at != nullptr && world.alive(*at);) {
        const auto* label = world.find<scene::NodeMetadata>(*at);
        if (label != nullptr && !label->name.empty()) return fmt::format("entity \"{}\"", label->name);
        const auto* parent = world.find<scene::Parent>(*at);
        at = parent != nullptr ? &parent->entity : nullptr;
    }
    return fmt::format("entity {}", entity.index);
}

}  // namespace

const std::vector<std::byte>& MaterialExtension::tables(const std::string& extension) const {
    const auto found = material.tables.find(extension);
    if (found == material.tables.end())
        refuse_input(file, pointer, "an extension without its tables", "a cooked scene",
                     "cook the file: rowland-cook cook SCENE.glb -o SCENE.scene");
    return *found->second;
}

void MaterialType::attach(ecs::World& /*world*/, ecs::Entity /*entity*/, const MaterialExtension& extension,
                          SurfaceTextures& /*textures*/) {
    ROWLAND_CHECK(false, "attach() on a material type without a glTF extension, for " + extension.pointer);
}

std::optional<gpu::ProgramDesc> MaterialType::overlay_program(ecs::World& /*world*/, ecs::Entity /*entity*/,
                                                              ProbeSlot /*slot*/) const {
    return std::nullopt;
}

std::vector<LaterProgram> MaterialType::later_programs(ecs::World& /*world*/, ecs::Entity /*entity*/,
                                                       ProbeSlot /*slot*/) const {
    return {};
}

void MaterialType::bind_overlay(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/,
                                const gpu::Program& /*program*/) const {
    ROWLAND_CHECK(false, "bind_overlay() on a material type without overlay_program()");
}

std::uint64_t object_number(ecs::Entity entity) {
    return (std::uint64_t{entity.index} << 32U) | entity.version;
}

ecs::Entity entity_of(std::uint64_t object_number) {
    return {.index = static_cast<std::uint32_t>(object_number >> 32U),
            .version = static_cast<std::uint32_t>(object_number)};
}

const MaterialType* owner_of(ecs::World& world, ecs::Entity entity,
                             std::span<const std::unique_ptr<MaterialType>> types, const std::string& file,
                             const std::string& json_pointer) {
    const MaterialType* owner = nullptr;
    for (const auto& type : types) {
        if (!type->owns(world, entity)) continue;
        if (owner != nullptr)
            refuse_input(file, (json_pointer.empty() ? "" : json_pointer + ", ") + entity_name(world, entity),
                         fmt::format("both {} and {}", owner->name(), type->name()), "at most one material type",
                         "remove one of the two from this surface");
        owner = type.get();
    }
    return owner;
}

}  // namespace rowland::render
