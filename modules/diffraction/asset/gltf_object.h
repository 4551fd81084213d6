#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "modules/diffraction/asset/gltf_extension.h"

namespace rowland::diffraction {

/// A material file's object as a glTF in `folder` holds it, as the value of kGltfExtension. "base" is left out: the
/// layer under the grating is the glTF material's own surface, with its textures. So is what a cook measures, which a
/// glTF material never is. Names of files, relative to the material file's folder `from`, become relative to `folder`.
/// `material` is sane (parse_material()). Throws Error (input) for a name that is not UTF-8.
nlohmann::ordered_json gltf_object(nlohmann::ordered_json material, const std::filesystem::path& from,
                                   const std::filesystem::path& folder);

/// Makes the names of files in a material's object, relative to the folder `from`, relative to `to`. Objects that are
/// not sane may stay as they are.
void move_named_files(nlohmann::ordered_json& object, const std::filesystem::path& from,
                      const std::filesystem::path& to);

/// "740 nm lamellar, grooves turned by 30 degrees, groove texture 2"
std::string describe(const GltfGrating& grating);

}  // namespace rowland::diffraction
