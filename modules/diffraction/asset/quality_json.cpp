#include "modules/diffraction/asset/quality_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rowland::diffraction {

namespace {

constexpr int kMostBands = 16;
constexpr int kMostArcRank = 16;   ///< three varyings for every four
constexpr int kMostLayers = 2048;  ///< of a texture array, on any device with OpenGL 4.5

int count(JsonReader& json, const std::string& key, int fallback, int minimum, int maximum) {
    return static_cast<int>(json.integer_or(key, fallback, minimum, maximum));
}

int parse_bands(JsonReader& json, int fallback) {
    return count(json, "bands", fallback, 1, kMostBands);
}

void check_layers(JsonReader& json, const std::string& key, int layers) {
    if (layers > kMostLayers)
        json.fail(key, std::to_string(layers) + " layers of four coefficients in all",
                  "at most " + std::to_string(kMostLayers), "take fewer bands or fewer " + key);
}

Storage parse_storage(JsonReader& json, Storage fallback) {
    const std::string name = json.choice_or("storage", storage_name(fallback), {"fp32", "fp16", "unorm16", "unorm8"});
    for (const Storage storage : {Storage::Float, Storage::Half, Storage::Unorm16})
        if (name == storage_name(storage)) return storage;
    return Storage::Unorm8;
}

ViewMapping parse_mapping(JsonReader& json, ViewMapping fallback, const Grating& grating) {
    const std::string name =
        json.choice_or("view_mapping", view_mapping_name(fallback), {"spherical", "parabolic", "one-dimensional"});
    if (name == "spherical") return ViewMapping::Spherical;
    if (name == "parabolic") return ViewMapping::Parabolic;
    if (!is_flat(grating.lobe))
        json.fail("view_mapping", "\"one-dimensional\" with a groove_lobe that is not flat",
                  "\"spherical\" or \"parabolic\"", "such a lobe sees the view along the grooves, too");
    return ViewMapping::OneDimensional;
}

/// "view_resolution" is the number of rows: spherical tables have twice as many columns, parabolic ones as many, and
/// one-dimensional ones that many nodes.
ViewGrid grid_of(ViewMapping mapping, int resolution) {
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

ViewGrid parse_grid(JsonReader& json, ViewMapping mapping, int resolution, const Grating& grating) {
    const ViewMapping wanted = parse_mapping(json, mapping, grating);
    const int fallback = wanted == ViewMapping::OneDimensional && mapping != wanted ? 256 : resolution;
    return grid_of(wanted, count(json, "view_resolution", fallback, 2, 512));
}

SpikeTableSettings parse_spikes(JsonReader& json, const Grating& grating) {
    SpikeTableSettings settings;
    settings.spikes.bands = parse_bands(json, settings.spikes.bands);
    settings.spikes.spikes = count(json, "spikes", settings.spikes.spikes, 1, 64);
    check_layers(json, "spikes", settings.spikes.spikes * spike_layers(settings.spikes.bands));
    const ViewGrid grid = parse_grid(json, settings.mapping, settings.theta_nodes, grating);
    settings.mapping = grid.mapping;
    settings.phi_nodes = grid.columns;
    settings.theta_nodes = grid.rows;
    settings.storage = parse_storage(json, settings.storage);
    return settings;
}

BinSettings parse_bins(JsonReader& json, const Grating& grating) {
    BinSettings settings;
    settings.bands = parse_bands(json, settings.bands);
    settings.bins = count(json, "bins", settings.bins, 1, 64);
    check_layers(json, "bins", settings.bins * transfer_layers(settings.bands));
    settings.grid = parse_grid(json, settings.grid.mapping, settings.grid.rows, grating);
    settings.storage = parse_storage(json, settings.storage);
    return settings;
}

TransferSettings parse_transfer(JsonReader& json, const Grating& grating) {
    TransferSettings settings;
    settings.bands = parse_bands(json, settings.bands);
    const ViewGrid usual = default_transfer_grid(grating.lobe);
    settings.grid = parse_grid(json, usual.mapping,
                               usual.mapping == ViewMapping::OneDimensional ? usual.columns : usual.rows, grating);
    settings.storage = parse_storage(json, settings.storage);
    return settings;
}

ArcSettings parse_arc(JsonReader& json, const Grating& grating) {
    ArcSettings settings;
    settings.bands = parse_bands(json, settings.bands);
    settings.rank = count(json, "rank", settings.rank, 1, kMostArcRank);
    const ViewGrid usual = default_transfer_grid(grating.lobe);
    const bool flat = usual.mapping == ViewMapping::OneDimensional;
    settings.grid = parse_grid(json, usual.mapping, flat ? usual.columns : usual.rows, grating);
    if (flat && settings.grid->mapping != usual.mapping)
        json.fail("view_mapping", std::string("\"") + view_mapping_name(settings.grid->mapping) + "\"",
                  "\"one-dimensional\" for arc with the flat groove_lobe",
                  "leave view_mapping out; arc moments depend on v_g alone");
    settings.storage = parse_storage(json, settings.storage);
    return settings;
}

void require_flat(JsonReader& json, const std::string& name, const Grating& grating) {
    if (is_flat(grating.lobe)) return;
    json.fail("representation", "\"" + name + "\" with a groove_lobe that is not flat",
              "\"spikes\", \"bins\", \"transfer\" or \"arc\"", "or make groove_lobe \"flat\"");
}

PlanarSettings parse_planar(JsonReader& json, const Grating& grating) {
    PlanarSettings settings;
    settings.stand_in.bands = parse_bands(json, settings.stand_in.bands);
    settings.stand_in.rank = count(json, "rank", settings.stand_in.rank, 1, kMostArcRank);
    settings.stand_in.grid = default_transfer_grid(grating.lobe);
    settings.size.views = count(json, "map_resolution", settings.size.views, 8, 1024);
    settings.size.azimuths = settings.size.views + settings.size.views % 2;
    return settings;
}

CircleSettings parse_circle(JsonReader& json) {
    CircleSettings settings;
    settings.size.side = count(json, "map_resolution", settings.size.side, 8, 128);
    settings.size.views = 2 * settings.size.side;
    return settings;
}

Representation parse_representation(JsonReader& json, const Grating& grating) {
    const std::string name =
        json.choice("representation", {"spikes", "bins", "transfer", "arc", "direct", "planar", "circle", "streak"});
    if (name == "streak")
        json.fail("representation", "\"streak\"", "a representation that surfaces are drawn with",
                  "rowland-trade evaluates streaks; \"spikes\", \"transfer\" and \"arc\" take any lobe");
    if (name == "planar" || name == "circle") require_flat(json, name, grating);
    if (name == "bins") return parse_bins(json, grating);
    if (name == "transfer") return parse_transfer(json, grating);
    if (name == "arc") return parse_arc(json, grating);
    if (name == "direct") return DirectSettings{};
    if (name == "planar") return parse_planar(json, grating);
    if (name == "circle") return parse_circle(json);
    return parse_spikes(json, grating);
}

/// Whether key lights are shaded apart unless a material says so.
bool takes_key_lights(const Representation& representation) {
    return !std::holds_alternative<SpikeTableSettings>(representation) &&
           !std::holds_alternative<BinSettings>(representation) &&
           !std::holds_alternative<TransferSettings>(representation);
}

/// Maps and lights of their own are of the probe less its key lights: nothing else would add those.
bool needs_key_lights(const Representation& representation) {
    return takes_key_lights(representation) && !std::holds_alternative<ArcSettings>(representation);
}

/// Built-in names only: a cooked material must not need another file to be read.
colour::Illuminant parse_illuminant(JsonReader& json) {
    const std::string name = json.text("illuminant");
    const std::vector<std::string> names = colour::illuminant_names();
    if (std::find(names.begin(), names.end(), name) == names.end())
        json.fail("illuminant", fmt::format("\"{:.40}\"", name), fmt::format("one of {}", fmt::join(names, ", ")),
                  "rowland-trade evaluates under any other");
    return colour::illuminant(name);
}

}  // namespace

Quality parse_quality(JsonReader json, const Grating& grating) {
    Quality quality;
    quality.max_error = json.number_or("max_error", quality.max_error, {.minimum = 0.0, .minimum_open = true});
    if (json.has("illuminant")) quality.illuminant = parse_illuminant(json);
    if (json.has("representation")) {
        quality.pinned = parse_representation(json, grating);
        quality.key_lights = json.boolean_or("key_lights", takes_key_lights(*quality.pinned));
        if (!quality.key_lights && needs_key_lights(*quality.pinned))
            json.fail("key_lights", "false", "true with this representation", "or leave it out");
    }
    json.finish();
    return quality;
}

}  // namespace rowland::diffraction
