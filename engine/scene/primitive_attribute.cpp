#include "engine/scene/primitive_attribute.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <optional>

#include "engine/core/error.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_json.h"

namespace rowland::scene {

namespace {

const GltfAccessor* accessor_of(const PrimitiveImport& import, const std::string& name) {
    const auto found = import.primitive.attributes.find(name);
    return found == import.primitive.attributes.end() ? nullptr : &import.document.accessors[found->second];
}

/// Draco's id of an attribute, if the stream holds it.
std::optional<std::uint32_t> draco_id(const PrimitiveImport& import, const std::string& name) {
    if (!import.draco) return std::nullopt;
    const auto& ids = import.primitive.draco->attributes;
    const auto found = ids.find(name);
    if (found == ids.end()) return std::nullopt;
    return found->second;
}

bool has_attribute(const PrimitiveImport& import, const std::string& name) {
    return accessor_of(import, name) != nullptr || draco_id(import, name);
}

/// Colours and weights are floats or normalised unsigned bytes or shorts, joints unsigned bytes or shorts (glTF 2.0,
/// 3.7.2.1).
void require_component_type(const PrimitiveImport& import, const std::string& name, bool is_fraction) {
    const GltfAccessor* accessor = accessor_of(import, name);
    if (!accessor || (is_fraction && accessor->type == ComponentType::Float)) return;
    const bool is_small = accessor->type == ComponentType::Uint8 || accessor->type == ComponentType::Uint16;
    if (!is_small || accessor->normalised != is_fraction)
        import.fail(fmt::format("{} of another type", name),
                    is_fraction ? "floats or normalised unsigned bytes or shorts" : "unsigned bytes or shorts");
}

std::vector<glm::u16vec4> read_joints(const PrimitiveImport& import, const std::string& name) {
    require_component_type(import, name, false);
    // Floats hold every 16-bit number exactly.
    const std::vector<glm::vec4> read = read_attribute<glm::vec4>(import, name);
    import.budget.spend(read.size(), sizeof(glm::u16vec4), import.pointer);
    std::vector<glm::u16vec4> joints;
    joints.reserve(read.size());
    for (const glm::vec4& joint : read) {
        for (int i = 0; i < 4; ++i)
            if (!(joint[i] >= 0.0F && joint[i] <= 65535.0F))
                import.fail(fmt::format("joint {}", joint[i]), "a number from 0 to 65535");
        joints.emplace_back(joint);
    }
    return joints;
}

void finish_weights(const PrimitiveImport& import, Skinning& skinning) {
    for (std::size_t i = 0; i < skinning.weights.size(); ++i) {
        glm::vec4& weights = skinning.weights[i];
        glm::dvec4 usable(0.0);
        for (int k = 0; k < 4; ++k) {
            if (std::isfinite(weights[k]) && weights[k] >= 0.0F)
                usable[k] = weights[k];
            else
                import.warn("joint weights that are negative or not numbers were set to 0");
        }
        const double sum = usable.x + usable.y + usable.z + usable.w;
        if (sum > 0.0) {
            weights = glm::vec4(usable / sum);
        } else {
            weights = glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
            import.warn("vertices without joint weights were given to their first joint");
        }
        // An unused slot may name anything.
        for (int k = 0; k < 4; ++k)
            if (weights[k] == 0.0F) skinning.joints[i][k] = 0;
    }
}

}  // namespace

void PrimitiveImport::fail(std::string found, std::string expected) const {
    refuse_input(document.file, pointer, std::move(found), std::move(expected));
}

void PrimitiveImport::warn(const std::string& text) const {
    warn_once(warnings, pointer + ": " + text);
}

template <typename Vector>
std::vector<Vector> read_attribute(const PrimitiveImport& import, const std::string& name) {
    const GltfAccessor* accessor = accessor_of(import, name);
    if (const auto id = draco_id(import, name))
        return import.draco->vectors<Vector>(*id, name, accessor && accessor->normalised);
    if (!accessor) return {};
    return read_vectors<Vector>(import.document, import.primitive.attributes.at(name), import.budget);
}
template std::vector<glm::vec2> read_attribute<glm::vec2>(const PrimitiveImport&, const std::string&);
template std::vector<glm::vec3> read_attribute<glm::vec3>(const PrimitiveImport&, const std::string&);
template std::vector<glm::vec4> read_attribute<glm::vec4>(const PrimitiveImport&, const std::string&);

std::vector<glm::vec4> read_colours(const PrimitiveImport& import) {
    const std::string name = "COLOR_0";
    require_component_type(import, name, true);
    const GltfAccessor* accessor = accessor_of(import, name);
    const auto id = draco_id(import, name);
    const int components = id ? import.draco->component_count(*id, name) : accessor ? accessor->rows : 4;
    std::vector<glm::vec4> colours;
    if (components == 3) {
        const std::vector<glm::vec3> opaque = read_attribute<glm::vec3>(import, name);
        import.budget.spend(opaque.size(), sizeof(glm::vec4), import.pointer);
        colours.reserve(opaque.size());
        for (const glm::vec3& colour : opaque) colours.emplace_back(colour, 1.0F);
    } else {
        colours = read_attribute<glm::vec4>(import, name);
    }
    for (glm::vec4& colour : colours) {
        if (!is_finite(colour)) {
            colour = glm::vec4(1.0F);
            import.warn("colours that are not numbers were set to white");
        }
        colour = glm::max(colour, glm::vec4(0.0F));
    }
    return colours;
}

Skinning read_skinning(const PrimitiveImport& import) {
    const bool has_joints = has_attribute(import, "JOINTS_0");
    if (has_joints != has_attribute(import, "WEIGHTS_0")) {
        import.warn("joints without weights, or weights without joints, are ignored");
        return {};
    }
    if (!has_joints) return {};
    if (has_attribute(import, "JOINTS_1")) warn_once(import.warnings, "joints beyond four a vertex are ignored");
    require_component_type(import, "WEIGHTS_0", true);
    Skinning skinning{read_joints(import, "JOINTS_0"), read_attribute<glm::vec4>(import, "WEIGHTS_0")};
    if (skinning.joints.size() != skinning.weights.size())
        import.fail(fmt::format("{} values of JOINTS_0", skinning.joints.size()),
                    fmt::format("as many as WEIGHTS_0, {}", skinning.weights.size()));
    finish_weights(import, skinning);
    return skinning;
}

}  // namespace rowland::scene
