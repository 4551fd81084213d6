#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

inline constexpr const char* kPortableFormat = "rowland-diffraction";
inline constexpr int kPortableVersion = 1;
inline constexpr int kViewDependentVersion = 2;  ///< of a document whose kernel depends on the view

/// Numbers for programs in any language: JSON, and the bytes that its arrays lie in. FORMAT.md states both.
struct PortableDocument {
    nlohmann::json json;
    std::vector<std::byte> bytes;  ///< little-endian floats
};

/// A document without contents, whose bytes will lie in the file `uri` beside it.
PortableDocument make_portable(const std::string& uri);

/// Adds "material": the kernel, the layers' weights and what shades a lobe and a cover. If the efficiencies depend on
/// the direction, adds them also and sets the document's version to kViewDependentVersion. The lobe must not be a pit
/// sequence.
void add_material(const CookedMaterial& cooked, PortableDocument& document);

/// Adds "arc": the table of the representation `arc`, with the matrix from SH to its light terms.
void add_arc(const ArcTable& table, PortableDocument& document);

/// Adds "probe": its key lights, and the raw SH of the rest of its light.
void add_probe(const EvaluationLight& light, int bands, PortableDocument& document);

/// Adds "planar": the map of a flat surface under the light without its key lights. The lobe is flat.
void add_planar_map(const CookedMaterial& cooked, const EvaluationLight& light, const glm::dvec3& normal,
                    const PlanarMapSize& size, PortableDocument& document);

}  // namespace rowland::diffraction
