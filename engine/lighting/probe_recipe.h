#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/procedural_probe.h"

namespace rowland::lighting {

struct ImageRecipe {
    std::string file;  ///< .hdr or .exr, relative to the recipe
    Mapping mapping = Mapping::Equirectangular;
};

/// The JSON recipe of a probe, { "probe": { "type": ..., ... } }. In parentheses: default; range.
/// All types: "intensity" (1), "bands" (16), "key_lights" (16; 0 to 64), "face_size" (256; face size of the
///   prefiltered cube map, a power of two), "illuminant" ("D65"; the spectrum of the probe's white: a built-in name or
///   a .csv file, relative to the recipe).
/// "studio": "ceiling", "wall", "floor" (radiance, three numbers each) and "boxes", objects with "azimuth_deg" (0 = −Z,
///   90 = +X), "elevation_deg", "roll_deg" (0), "half_size_deg" (half width, half height), "soft_edge_deg" (0),
///   "radiance".
/// "clear_sky": "sun_azimuth_deg", "sun_elevation_deg" (1 to 90), "sun_angular_diameter_deg" (0.533), "turbidity"
///   (3; 2 to 6), "ground_albedo" (0.2, 0.2, 0.2).
/// "studio" and "clear_sky": "width" (1024; a multiple of 4).
/// "image": "file" (.hdr or .exr, relative to the recipe), "mapping" ("equirect"; or "angular"), "dome" (none; shows
///   the image as a room: "height_m" of the camera above the floor, and "radius_m").
struct ProbeRecipe {
    std::variant<StudioRecipe, ClearSkyRecipe, ImageRecipe> source;
    int width = 1024;      ///< of a procedural recipe's equirectangular image, texels; its height is width/2
    double intensity = 1;  ///< multiplies all radiance
    LightProbeSettings settings;
    std::string illuminant_file;  ///< .csv, relative to the recipe; empty: settings.illuminant is built in
};

/// Parses strictly: an unknown key, a wrong type or a number out of range is an Error (input) that names it.
ProbeRecipe parse_probe_recipe(const nlohmann::json& json, const std::string& file);
ProbeRecipe parse_probe_recipe(JsonReader& document);

/// If the recipe names an illuminant file, loads it into `settings.illuminant`. `load_text` is called with
/// illuminant_file and returns its text. Throws Error (input) as parse_illuminant() does.
void load_illuminant(ProbeRecipe& recipe, const std::function<std::string(const std::string&)>& load_text);

/// The probe at full resolution. `load` is called with ImageRecipe::file and returns its image. Logs the warnings of
/// warn_about(). Errors (input) name `file`.
ProbeImage render_recipe(const ProbeRecipe& recipe, const std::function<image::Image(const std::string&)>& load,
                         const std::string& file);

/// A probe at full resolution, for the reference.
struct FullResolutionProbe {
    ProbeImage image;
    int key_lights = 16;  ///< the most that it is cooked with
};

/// Reads a probe recipe (.json) or an image. `mapping` is an image's, as for parse_mapping(); recipes do not use it.
/// Takes seconds. Throws Error (input).
FullResolutionProbe load_full_resolution_probe(const std::filesystem::path& path, const std::string& mapping);

}  // namespace rowland::lighting
