#include "engine/scene/gltf_skin.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_index.h"

namespace rowland::scene {

namespace {

// Vertices name joints with 16 bits.
constexpr std::size_t kMaximumJoints = std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;

/// As vertices need it: finite, and affine whatever rounding left in the bottom row.
glm::mat4 checked_bind(glm::mat4 matrix, const std::string& file, const std::string& place) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(matrix[column][row]))
                refuse_input(file, place, "an inverse bind matrix that is infinite or not a number", "finite numbers");
        matrix[column][3] = column == 3 ? 1.0F : 0.0F;
    }
    return matrix;
}

}  // namespace

std::vector<GltfSkin> read_skins(const nlohmann::json& json, const std::string& file) {
    std::vector<GltfSkin> skins;
    for (JsonReader& skin : root_objects(json, file, "skins")) {
        text_if_there(skin, "name");
        GltfSkin& added = skins.emplace_back();
        added.joints = indices_if_there(json, skin, "joints", "nodes");
        if (added.joints.empty() || added.joints.size() > kMaximumJoints)
            skin.fail("joints", fmt::format("{} joints", added.joints.size()), fmt::format("1 to {}", kMaximumJoints));
        added.inverse_bind = index_if_there(json, skin, "inverseBindMatrices", "accessors");
        index_if_there(json, skin, "skeleton", "nodes");
    }
    return skins;
}

ImportedSkin import_skin(const GltfDocument& document, std::size_t skin,
                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget) {
    const GltfSkin& from = document.skins.at(skin);
    const std::string place = fmt::format("/skins/{}", skin);
    budget.spend(from.joints.size(), sizeof(std::size_t) + sizeof(glm::mat4), place);
    ImportedSkin to;
    for (const std::size_t joint : from.joints) {
        if (!shown[joint])
            refuse_input(document.file, place + "/joints", fmt::format("joint {} outside the scene", joint),
                         "joints in the scene of the skinned mesh", "put the skeleton into the scene");
        to.joints.push_back(*shown[joint]);
    }
    to.inverse_bind.assign(from.joints.size(), glm::mat4(1.0F));
    if (!from.inverse_bind) return to;
    require_data(document, *from.inverse_bind, place, "inverseBindMatrices");
    const std::vector<glm::mat4> given = read_matrices(document, *from.inverse_bind, budget);
    if (given.size() < from.joints.size())
        refuse_input(document.file, place, fmt::format("{} inverse bind matrices", given.size()),
                     fmt::format("one for each of the {} joints", from.joints.size()));
    for (std::size_t i = 0; i < to.inverse_bind.size(); ++i)
        to.inverse_bind[i] = checked_bind(given[i], document.file, place);
    return to;
}

}  // namespace rowland::scene
