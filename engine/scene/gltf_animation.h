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

/// The animations of a glTF's JSON, checked as they are read; of their channels those that move nodes. Throws Error
/// (input).
std::vector<GltfAnimation> read_animations(const nlohmann::json& json, const std::string& file,
                                           std::vector<std::string>& warnings);

/// The animations of a checked document that move shown nodes: `shown` has the place of each of the document's nodes
/// among those. Throws Error (input) if keys are not finite, not ascending or of the wrong type or number.
std::vector<Animation> import_animations(const GltfDocument& document,
                                         std::span<const std::optional<std::size_t>> shown, MemoryBudget& budget);

}  // namespace rowland::scene
