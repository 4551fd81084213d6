#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/json_reader.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The groove lobes that a representation can shade. `Mirroring`: a Gaussian, or pits with a coherent fraction, which
/// reflect like a mirror along the grooves.
enum class Lobes { Any, Flat, Mirroring };

/// The surface that errors are measured on: one plane, or a curved body.
enum class SurfaceShape { Flat, Curved };

/// Whether the probe's key lights are shaded one by one, in addition to the residual probe.
enum class KeyLightUse { OnRequest, ByDefault, Always };

/// A setting: a member of a material file's "quality", and key=value in a method's name.
struct SettingInfo {
    const char* key = "";
    const char* label = "";  ///< for people
    const char* help = "";
    int minimum = 0;                        ///< of a whole number, inclusive
    int maximum = 0;                        ///< likewise
    std::vector<std::string_view> words{};  ///< not empty: the setting is one of these words, not a number
    /// Null if it depends on the grating or on other settings.
    nlohmann::json default_value{};
};

/// A setting that no longer exists, and the one that replaced it.
struct ReplacedSetting {
    const char* key = "";
    const char* by = "";
};

/// The description of a representation for parsers, schemas, editors and budgets.
struct RepresentationInfo {
    const char* name;          ///< in material files and methods
    std::uint8_t file_number;  ///< in cooked files; 1 is taken by one that no longer exists
    const char* summary;       ///< one line for people
    Lobes lobes = Lobes::Any;
    bool is_map = false;              ///< filled from the probe at run time; directional lights are shaded separately
    bool lattices = false;            ///< it also shades lattices
    bool needs_flat_surface = false;  ///< curved meshes are shaded by a stand-in
    bool takes_harmonics = false;     ///< light is given as SH, to which windows apply
    KeyLightUse key_lights = KeyLightUse::ByDefault;
    std::vector<SettingInfo> settings{};
    std::vector<ReplacedSetting> replaced{};
    /// What a budget may try for a grating and a surface.
    std::vector<std::string> (*budget)(const Grating& grating, SurfaceShape surface) = nullptr;

    const SettingInfo* find(std::string_view key) const;
};

/// Settings of one representation, each within its SettingInfo's limits.
class SettingValues {
 public:
    /// Reads the settings of `info` from `json`. Throws Error (input) for a number out of its limits, an unknown word
    /// or a setting that was replaced.
    SettingValues(const RepresentationInfo& info, JsonReader& json);

    bool has(const char* key) const { return values_.contains(key); }
    /// The given value, or the setting's default, which must exist.
    int number(const char* key) const;
    int number_or(const char* key, int fallback) const;
    std::string word_or(const char* key, const std::string& fallback) const;
    Storage storage() const;

 private:
    const RepresentationInfo* info_;
    nlohmann::json values_ = nlohmann::json::object();
};

/// Settings that several representations have.
SettingInfo bands_setting();
SettingInfo rank_setting();
SettingInfo map_resolution_setting(int default_value, int maximum);
SettingInfo view_mapping_setting();
SettingInfo view_resolution_setting();
SettingInfo storage_setting(Storage default_value);

/// The default grid of arc tables, with measured errors. Flat lobe: 256 nodes over v_g, an error of 1e-4 or less for
/// pitches of 740 nm or more. Others: 64 × 32 spherical nodes, .3 % for a lobe with a sigma of .3 under 5 bands (as
/// many parabolic nodes: .9 %), and .7 to 1.6 % for a lattice.
ViewGrid default_view_grid(const Grating& grating);

/// "view_resolution" is the number of rows: spherical tables have twice as many columns, parabolic ones as many, and
/// one-dimensional ones that many nodes.
ViewGrid view_grid(ViewMapping mapping, int resolution);
/// The grid that "view_mapping" and "view_resolution" ask for. An absent one is taken from `defaults`.
ViewGrid view_grid(const SettingValues& values, const ViewGrid& defaults);
/// Refuses a one-dimensional grid for a grating that depends on more than v_g.
std::optional<Refusal> view_grid_refusal(const SettingValues& values, const Grating& grating);
/// Refuses more layers of four coefficients than every device supports in a texture array. `key`: the setting to blame.
std::optional<Refusal> layer_refusal(const char* key, int layers);

/// "name: value" lines for people.
using Facts = std::vector<std::pair<std::string, std::string>>;
/// Appends the facts of a table over views.
Facts with_view_table(Facts facts, const ViewGrid& grid, const PackedTexels& packed);

/// Bytes of SH light per vertex.
std::size_t harmonics_bytes(int bands);

/// Throws Error (input) unless `is_so`. A file's table must have the sizes that its material asks for, since only the
/// material's are checked against the limits of shaders and textures.
void require_as_asked(const ByteReader& reader, bool is_so);

}  // namespace rowland::diffraction
