#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/scene/gltf_accessor.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

// Vertices name joints with 16 bits.
constexpr std::size_t kMaximumJoints = std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;

/// The matrix with the bottom row of an affine one. Throws if it is not finite.
glm::mat4 checked_bind(glm::mat4 matrix, const std::string& file, const std::string& pointer) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(matrix[column][row]))
                refuse_input(file, pointer, "an inverse bind matrix that is infinite or not a number",
                             "finite numbers");
        matrix[column][3] = column == 3 ? 1.0F : 0.0F;
    }
    return matrix;
}

}  // namespace

std::vector<GltfSkin> read_skins(const GltfJson& json) {
    std::vector<GltfSkin> skins;
    for (JsonReader& skin : json.objects("skins")) {
        skin.text_or("name", "");
        GltfSkin& to = skins.emplace_back();
        to.joints = json.indices_if_there(skin, "joints", "nodes");
        if (to.joints.empty() || to.joints.size() > kMaximumJoints)
            skin.fail("joints", fmt::format("{} joints", to.joints.size()), fmt::format("1 to {}", kMaximumJoints));
        to.inverse_bind = json.index_if_there(skin, "inverseBindMatrices", "accessors");
        json.index_if_there(skin, "skeleton", "nodes");
    }
    return skins;
}

ImportedSkin import_skin(const GltfDocument& document, std::size_t skin,
                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget) {
    const GltfSkin& from = document.skins.at(skin);
    const std::string pointer = fmt::format("/skins/{}", skin);
    budget.spend(from.joints.size(), sizeof(std::size_t) + sizeof(glm::mat4), pointer);
    ImportedSkin to;
    for (const std::size_t joint : from.joints) {
        if (!shown[joint])
            refuse_input(document.file, pointer + "/joints", fmt::format("joint {} outside the scene", joint),
                         "joints in the scene of the skinned mesh", "put the skeleton into the scene");
        to.joints.push_back(*shown[joint]);
    }
    to.inverse_bind.assign(from.joints.size(), glm::mat4(1.0F));
    if (!from.inverse_bind) return to;
    const std::vector<glm::mat4> given = read_matrices(document, *from.inverse_bind, budget);
    if (given.size() < from.joints.size())
        refuse_input(document.file, pointer, fmt::format("{} inverse bind matrices", given.size()),
                     fmt::format("one for each of the {} joints", from.joints.size()));
    for (std::size_t i = 0; i < to.inverse_bind.size(); ++i)
        to.inverse_bind[i] = checked_bind(given[i], document.file, pointer);
    return to;
}

}  // namespace rowland::scene
