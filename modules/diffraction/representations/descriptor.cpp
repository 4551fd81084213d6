#include "modules/diffraction/representations/descriptor.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

constexpr int kMostBands = 16;
constexpr int kMostArcRank = 16;   ///< every four take three varyings
constexpr int kMostLayers = 2048;  ///< of a texture array, on any device with OpenGL 4.5
constexpr int kOneDimensionalNodes = 256;

}  // namespace

const SettingInfo* RepresentationInfo::find(std::string_view key) const {
    const auto found =
        std::find_if(settings.begin(), settings.end(), [&](const SettingInfo& setting) { return setting.key == key; });
    return found != settings.end() ? &*found : nullptr;
}

SettingValues::SettingValues(const RepresentationInfo& info, JsonReader& json) : info_(&info) {
    for (const ReplacedSetting& old : info.replaced)
        json.refuse_if_there(old.key, fmt::format("a setting that \"{}\" no longer has", info.name),
                             fmt::format("\"{}\", which replaced it", old.by));
    for (const SettingInfo& setting : info.settings) {
        if (!json.has(setting.key)) continue;
        if (setting.words.empty())
            values_[setting.key] = json.integer(setting.key, setting.minimum, setting.maximum);
        else
            values_[setting.key] = json.choice(setting.key, setting.words);
    }
}

int SettingValues::number(const char* key) const {
    const SettingInfo* setting = info_->find(key);
    ROWLAND_CHECK(setting != nullptr && setting->default_value.is_number(), key);
    return number_or(key, setting->default_value.get<int>());
}

int SettingValues::number_or(const char* key, int fallback) const {
    return has(key) ? values_[key].get<int>() : fallback;
}

std::string SettingValues::word_or(const char* key, const std::string& fallback) const {
    return has(key) ? values_[key].get<std::string>() : fallback;
}

Storage SettingValues::storage() const {
    return parse_storage(word_or("storage", info_->find("storage")->default_value.get<std::string>()));
}

SettingInfo bands_setting() {
    return {.key = "bands",
            .label = "Bands",
            .help = "Bands n of spherical harmonics, n² coefficients. More follow sharper light.",
            .minimum = 1,
            .maximum = kMostBands,
            .default_value = 5};
}

SettingInfo rank_setting() {
    return {.key = "rank",
            .label = "Rank",
            .help = "Products of the arc table's decomposition.",
            .minimum = 1,
            .maximum = kMostArcRank,
            .default_value = 8};
}

SettingInfo map_resolution_setting(int default_value, int maximum) {
    return {.key = "map_resolution",
            .label = "Map resolution",
            .help = "Cells along a side of the map.",
            .minimum = 8,
            .maximum = maximum,
            .default_value = default_value};
}

SettingInfo view_mapping_setting() {
    return {.key = "view_mapping",
            .label = "View mapping",
            .help = "How the table covers the views. One-dimensional: v_g alone, for the flat lobe.",
            .words = {"spherical", "parabolic", "one-dimensional"}};
}

SettingInfo view_resolution_setting() {
    return {.key = "view_resolution",
            .label = "View resolution",
            .help = "Rows of the table over views; nodes, where it is one-dimensional.",
            .minimum = 2,
            .maximum = 512};
}

SettingInfo storage_setting(Storage default_value) {
    return {.key = "storage",
            .label = "Storage",
            .help = "Format of a table's components.",
            .words = {"fp32", "fp16", "unorm16", "unorm8"},
            .default_value = storage_name(default_value)};
}

ViewGrid default_view_grid(const Grating& grating) {
    if (sees_v_g_alone(grating))
        return {.mapping = ViewMapping::OneDimensional, .columns = kOneDimensionalNodes, .rows = 1};
    return {.mapping = ViewMapping::Spherical, .columns = 64, .rows = 32};
}

ViewGrid view_grid(ViewMapping mapping, int resolution) {
    switch (mapping) {
        case ViewMapping::Spherical:
            return {.mapping = mapping, .columns = 2 * resolution, .rows = resolution};
        case ViewMapping::Parabolic:
            return {.mapping = mapping, .columns = resolution, .rows = resolution};
        case ViewMapping::OneDimensional:
            break;
    }
    return {.mapping = ViewMapping::OneDimensional, .columns = resolution, .rows = 1};
}

ViewGrid view_grid(const SettingValues& values, const ViewGrid& defaults) {
    const ViewMapping mapping =
        values.has("view_mapping") ? parse_view_mapping(values.word_or("view_mapping", "")) : defaults.mapping;
    const bool one_dimensional = mapping == ViewMapping::OneDimensional;
    int resolution = one_dimensional ? kOneDimensionalNodes : defaults.rows;
    if (one_dimensional && defaults.mapping == mapping) resolution = defaults.columns;
    return view_grid(mapping, values.number_or("view_resolution", resolution));
}

std::optional<Refusal> view_grid_refusal(const SettingValues& values, const Grating& grating) {
    if (values.word_or("view_mapping", "") != "one-dimensional" || sees_v_g_alone(grating)) return std::nullopt;
    return Refusal{
        "view_mapping",
        fmt::format("\"one-dimensional\" with {}", grating.lattice ? "a lattice" : "a groove_lobe that is not flat"),
        "\"spherical\" or \"parabolic\"", "radiance also depends on v_h, the view along the grooves"};
}

std::optional<Refusal> layer_refusal(const char* key, int layers) {
    if (layers <= kMostLayers) return std::nullopt;
    return Refusal{key, fmt::format("{} layers of four coefficients in all", layers),
                   fmt::format("at most {}", kMostLayers), fmt::format("take fewer bands or fewer {}", key)};
}

Facts with_view_table(Facts facts, const ViewGrid& grid, const PackedTexels& packed) {
    facts.emplace_back("view_mapping", view_mapping_name(grid.mapping));
    facts.emplace_back("view_table", fmt::format("{} x {} x {} layers", grid.columns, grid.rows, packed.scale.size()));
    facts.emplace_back("storage", storage_name(packed.storage));
    return facts;
}

std::size_t harmonics_bytes(int bands) {
    return static_cast<std::size_t>(bands * bands) * 3 * sizeof(float);
}

void require_as_asked(const ByteReader& reader, bool is_so) {
    if (!is_so) reader.fail("a table of other bands, sizes or storage", "the table that the material asks for");
}

}  // namespace rowland::diffraction
