#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/core/json_reader.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::diffraction {

/// The layer under the grating: a dielectric, lit by the light that the orders do not diffract.
struct BaseLayer {
    glm::vec3 colour{0.0F};  ///< linear Rec.709 albedo, 0…1
    float roughness = 0.3F;  ///< perceptual, 0…1
};

/// A light probe that errors are measured under, as a material names it.
struct MeasuredProbe {
    std::string file;  ///< beside the material: a recipe (.json), or an image
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;  ///< of an image
};

/// The number that an error is: what "measure" names in a material.
enum class ErrorMeasure {
    RelativeRms,  ///< "relative_rms": relative RMS of XYZ over the views (PHYSICS §1)
    DeltaE,       ///< "delta_e": CIEDE2000 that 95 % of the views do not exceed, exposed for the reference
    HdrFlip,      ///< "hdr_flip": mean HDR-FLIP over a picture, 0 (looks the same) to 1
};

/// An error that is tolerated, or a representation that is pinned.
struct Quality {
    double max_error = 0.05;  ///< against the reference, > 0, as `measure` says
    ErrorMeasure measure = ErrorMeasure::RelativeRms;
    std::vector<MeasuredProbe> probes;          ///< that max_error is for; none: the built-in clear sky
    SurfaceShape surface = SurfaceShape::Flat;  ///< that max_error is for
    std::optional<Representation> pinned;
    /// The largest number of the probe's key lights, the most important first, that are shaded one by one at full
    /// sharpness. The others remain in the probe. 0 to lighting::kMaximumKeyLights, which is all.
    int key_lights = 0;
    /// Key lights and directional lights are shaded per vertex, for dense meshes, instead of per pixel.
    bool lights_at_vertices = false;
    bool map_at_vertices = false;                   ///< the map of `planar` or `circle` is read per vertex
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the light's white that tables are baked for
};

/// A grating material: the parsed material file.
struct Material {
    Grating grating;
    BaseLayer base;
    Quality quality;
};

/// The material with the efficiencies that its theory asks for, which take seconds to solve: rigorous/efficiencies.h.
/// Throws Error (input) naming `file`.
Material with_efficiencies(Material material, const std::string& file);

/// The representation to bake: the pinned one, else `spikes`, or `planar` for a lattice. A cooker pins the one that it
/// chooses for max_error.
Representation representation(const Material& material);

/// A file that a material names, and what messages call it.
struct NamedText {
    std::string text;
    std::string file;
};

/// Reads a file that a material names: "file" of a table or a height map, "illuminant" of its quality. Throws Error
/// (input) if it cannot.
using ReadNamed = std::function<NamedText(const std::string& name)>;

/// The largest file that a material may name.
inline constexpr std::uint64_t kMaximumNamedFileSize = 16 << 20;

/// Reads names relative to a folder.
ReadNamed read_beside(std::filesystem::path folder);

/// Parses the material object of a .json file or of the glTF extension. Every failure is an Error (input) that names
/// `file`, the JSON pointer, what was found and what was expected; unknown keys name the nearest valid one.
Material parse_material(const nlohmann::json& json, const std::string& file, const ReadNamed& read);
/// The same, where names are relative to the folder of `file`.
Material parse_material(const nlohmann::json& json, const std::string& file);
/// Parses the members that a material file and the glTF extension have in common: all of a material file's. The caller
/// then reads its own members and calls finish().
Material parse_material(JsonReader& reader, const ReadNamed& read);

/// A material file's JSON, not checked yet. Throws Error (input).
nlohmann::json load_material_json(const std::filesystem::path& path);
/// Reads and parses a material file. Throws Error (input). Its efficiencies are not solved yet: with_efficiencies().
Material load_material(const std::filesystem::path& path);

/// The parts of a material. They throw Error (input).
/// A groove's profile, by profile_descriptors(); without `read`, profiles that name a file are refused.
Profile parse_profile(JsonReader json, double pitch_nm, const ReadNamed& read);
/// The grating of a file that has a "lattice" in place of "pitch_nm": lattice, its profile, its orders.
Grating parse_lattice_grating(JsonReader& json, const ReadNamed& read);
/// "quality": a tolerated error, or a representation with its settings, which must suit the grating (refusal()).
Quality parse_quality(JsonReader json, const Grating& grating, const ReadNamed& read);

/// Parses a table of efficiencies: CSV with the header `wavelength_nm,R-2,R-1,R+0,R+1,…`, one column per order in any
/// order, and, for several angles of incidence, a second column `incidence_deg` in (−90, 90). Wavelengths ascend
/// (within each incidence) and reach into 380–780 nm; efficiencies are ≥ 0 and a row sums to at most
/// 1 + kRowSumTolerance. Throws Error (input) naming `file` and the row.
EfficiencyTable parse_efficiency_csv(std::string_view text, const std::string& file);
/// The text that parse_efficiency_csv() reads back to the same numbers.
std::string write_efficiency_csv(const EfficiencyTable& table);

/// The largest width and height of a cell's picture.
inline constexpr int kLargestHeightMap = 256;
/// The heights of one cell from the text of a PNG, whose red is the height. The depth is not set. Throws Error (input).
HeightMap read_height_map(const NamedText& png);
/// A PNG of the same heights, as text.
std::string write_height_map(const HeightMap& map);

/// Weights by which the engine shades what the orders leave: XYZ of the illuminant's white (Y = 1) after the grating.
struct LayerWeights {
    glm::dvec3 mirror{0.0};  ///< the zero order, unless `orders` lists 0 (then the diffraction term shades it); a
                             ///< sheet that transmits sends it straight on
    glm::dvec3 base{1.0};  ///< 1 − Σ listed η − η₀, of both sides of a sheet, at least 0: the light that reaches
                           ///< the base layer. 0 for a sheet's reflected side alone
    glm::dvec3 reflected{0.0};  ///< Σ listed η + η₀; 0 for a sheet that transmits
};

/// PHYSICS §2, "Zero order". Each weight is ∫ w(λ) cmf(λ) S(λ) dλ, S the illuminant, of luminance 1.
LayerWeights layer_weights(const Grating& grating, const colour::Illuminant& illuminant = colour::d65());

}  // namespace rowland::diffraction
