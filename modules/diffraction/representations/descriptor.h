#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The groove lobes that a representation can shade. `Mirroring`: a Gaussian, or pits with a coherent fraction, which
/// reflect like a mirror along the grooves.
enum class Lobes { Any, Flat, Mirroring };

/// What errors are measured on: one plane, or all orientations that a curved body shows.
enum class SurfaceShape { Flat, Curved };

/// Whether the probe's key lights are shaded one by one, on top of what they leave of the probe.
enum class KeyLightUse { OnRequest, ByDefault, Always };

/// A setting: a member of a material file's "quality", and key=value where a method is named.
struct SettingInfo {
    const char* key = "";
    const char* label = "";  ///< for people
    const char* help = "";
    int minimum = 0;  ///< of a whole number; both ends are allowed
    int maximum = 0;
    std::vector<std::string_view> words{};  ///< not empty: the setting is one of these words, not a number
    /// What an absent setting means; null where that depends on the grating or on other settings.
    nlohmann::json default_value{};
    std::vector<nlohmann::json> sweep{};  ///< values at which the sweep varies it
    /// Values in the demo: coarse, default, fine; empty: the demo leaves it at its default.
    std::vector<int> details{};
};

/// Everything that parsers, schemas, editors, sweeps, budgets and tables know of a representation.
struct RepresentationInfo {
    const char* name;     ///< in material files and methods
    const char* summary;  ///< one line for people
    Lobes lobes = Lobes::Any;
    bool is_map = false;              ///< a map that is filled from the probe at run time, beside separate lights
    bool needs_flat_surface = false;  ///< curved meshes are shaded by a stand-in
    bool takes_harmonics = false;     ///< light comes as SH, on which a window has an effect
    bool in_demo = true;              ///< among the looks that the demo compares
    KeyLightUse key_lights = KeyLightUse::ByDefault;
    std::vector<SettingInfo> settings{};
    std::vector<const char*> editor_start{};  ///< settings that an editor writes when the representation is chosen
    const char* sweep_tier = "";              ///< settings of the sweep's starting point; key_lights may be among them
    std::vector<int> sweep_key_lights{};      ///< numbers of key lights that the sweep takes
    std::vector<math::SphericalWindow> sweep_windows{};
    std::vector<std::string> sweep_more{};  ///< further settings of the sweep
    /// What a budget may try for a lobe and a surface.
    std::vector<std::string> (*budget)(bool flat_lobe, SurfaceShape surface) = nullptr;

    const SettingInfo* find(std::string_view key) const;
};

/// Why a grating and settings do not suit each other, as the parts of an Error. `key`: the member of "quality" or, with
/// a leading '/', of the material.
struct Refusal {
    std::string key;
    std::string found;
    std::string expected;
    std::string remedy{};
};

/// Settings of one representation, each within its SettingInfo's limits.
class SettingValues {
 public:
    /// Takes the members of `info` out of `json`. Throws Error (input) for a value out of its limits.
    SettingValues(const RepresentationInfo& info, JsonReader& json);

    bool has(const char* key) const { return values_.contains(key); }
    /// The value given, or the setting's default. The setting must have one.
    int number(const char* key) const;
    int number_or(const char* key, int fallback) const;
    std::string word_or(const char* key, const std::string& fallback) const;
    Storage storage() const;

 private:
    const RepresentationInfo* info_;
    nlohmann::json values_ = nlohmann::json::object();
};

/// Settings that several representations have.
SettingInfo bands_setting(std::vector<nlohmann::json> sweep = {}, std::vector<int> details = {});
SettingInfo rank_setting(std::vector<nlohmann::json> sweep = {}, std::vector<int> details = {});
SettingInfo map_resolution_setting(int default_value, int maximum, std::vector<nlohmann::json> sweep,
                                   std::vector<int> details);
SettingInfo view_mapping_setting();
SettingInfo view_resolution_setting(std::vector<nlohmann::json> sweep = {});
SettingInfo storage_setting(Storage default_value, std::vector<nlohmann::json> sweep = {});

/// Layers of four that bands² coefficients take: ⌈bands²/4⌉.
constexpr int harmonic_layers(int bands) {
    return (bands * bands + 3) / 4;
}

/// 256 nodes over v_g for the flat lobe, which are 1e-4 of radiance or less from 740 nm pitch on; 64 × 32 spherical for
/// others: .3 % where a lobe of .3 is lit by 5 bands, .9 % for as many parabolic ones (measured).
ViewGrid default_view_grid(const GrooveLobe& lobe);

/// "view_resolution" is the number of rows: spherical tables have twice as many columns, parabolic ones as many, and
/// one-dimensional ones that many nodes.
ViewGrid view_grid(ViewMapping mapping, int resolution);
/// The grid that "view_mapping" and "view_resolution" ask for, of `defaults` where they are absent.
ViewGrid view_grid(const SettingValues& values, const ViewGrid& defaults);
/// A one-dimensional grid under a lobe that sees the view along the grooves.
std::optional<Refusal> view_grid_refusal(const SettingValues& values, const Grating& grating);
/// More layers of four coefficients than a texture array has on every device.
std::optional<Refusal> layer_refusal(const char* key, int layers);

/// "name: value" lines for people.
using Facts = std::vector<std::pair<std::string, std::string>>;
/// The same with those of a table over views.
Facts with_view_table(Facts facts, const ViewGrid& grid, const PackedTexels& packed);

/// Bytes of SH light per vertex.
std::size_t harmonics_bytes(int bands);

/// Refuses a file's table that is not the one its material asks for: the material's limits are those of shaders and
/// textures.
void require_as_asked(const ByteReader& reader, bool is_so);

}  // namespace rowland::diffraction
