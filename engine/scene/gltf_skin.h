#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// The skins of a glTF's JSON, checked as they are read. Throws Error (input).
std::vector<GltfSkin> read_skins(const nlohmann::json& json, const std::string& file);

/// One skin of a checked document, its joints as shown nodes: `shown` has the place of each of the document's nodes
/// among those. Throws Error (input) if a joint is not shown, or if the inverse bind matrices are too few or not
/// finite.
ImportedSkin import_skin(const GltfDocument& document, std::size_t skin,
                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget);

}  // namespace rowland::scene
