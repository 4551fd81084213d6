#include "modules/diffraction/asset/quality_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rowland::diffraction {

namespace {

constexpr int kMostBands = 16;
constexpr int kMostArcRank = 16;  ///< three varyings for every four
constexpr std::size_t kMostProbes = 16;
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
              "\"spikes\", \"bins\", \"transfer\", \"arc\" or \"streak\"", "or make groove_lobe \"flat\"");
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

StreakSurfaceSettings parse_streak(JsonReader& json, const Grating& grating) {
    const auto* pits = std::get_if<PitsLobe>(&grating.lobe);
    if (is_flat(grating.lobe) || (pits != nullptr && pits->coherent == 0.0))
        json.fail(
            "representation",
            pits ? "\"streak\" with pits that have no coherent share" : "\"streak\" with a groove_lobe that is flat",
            "a groove_lobe with a sigma, or with pits and a coherent share",
            "\"arc\", \"transfer\", \"bins\" and \"spikes\" take any lobe");
    StreakSurfaceSettings settings;
    settings.streak.nodes_per_order = count(json, "nodes", settings.streak.nodes_per_order, 1, 32);
    const std::size_t nodes = grating.orders.size() * static_cast<std::size_t>(settings.streak.nodes_per_order);
    if (nodes > kMostStreakNodes)
        json.fail("nodes", fmt::format("{} nodes for all orders", nodes), fmt::format("at most {}", kMostStreakNodes),
                  "take fewer nodes or list fewer orders");
    settings.taps = count(json, "taps", settings.taps, 1, kMostStreakTaps);
    ArcSettings rest;
    rest.bands = parse_bands(json, rest.bands);
    rest.rank = count(json, "rank", rest.rank, 1, kMostArcRank);
    const ViewGrid usual = default_transfer_grid(grating.lobe);
    rest.grid = grid_of(usual.mapping, count(json, "view_resolution", usual.rows, 2, 512));
    if (incoherent_rest(grating)) settings.rest = rest;
    return settings;
}

Representation parse_representation(JsonReader& json, const Grating& grating) {
    const std::string name =
        json.choice("representation", {"spikes", "bins", "transfer", "arc", "direct", "planar", "circle", "streak"});
    if (name == "planar" || name == "circle") require_flat(json, name, grating);
    if (name == "bins") return parse_bins(json, grating);
    if (name == "transfer") return parse_transfer(json, grating);
    if (name == "arc") return parse_arc(json, grating);
    if (name == "direct") return DirectSettings{};
    if (name == "planar") return parse_planar(json, grating);
    if (name == "circle") return parse_circle(json);
    if (name == "streak") return parse_streak(json, grating);
    return parse_spikes(json, grating);
}

/// Whether key lights are shaded apart unless a material says so.
bool takes_key_lights(const Representation& representation) {
    return !std::holds_alternative<SpikeTableSettings>(representation) &&
           !std::holds_alternative<BinSettings>(representation) &&
           !std::holds_alternative<TransferSettings>(representation);
}

/// Lights of their own are all that is shaded, or part of what the streak's pits are.
bool needs_key_lights(const Representation& representation) {
    return std::holds_alternative<DirectSettings>(representation) ||
           std::holds_alternative<StreakSurfaceSettings>(representation);
}

bool is_map(const Representation& representation) {
    return std::holds_alternative<PlanarSettings>(representation) ||
           std::holds_alternative<CircleSettings>(representation);
}

/// Maps shade directional lights on their own even where they hold the key lights.
bool has_separate_lights(const Quality& quality) {
    return quality.key_lights || is_map(*quality.pinned);
}

bool at_vertices(JsonReader& json, const char* key) {
    return json.choice_or(key, "pixels", {"pixels", "vertices"}) == "vertices";
}

/// A built-in illuminant, or one of a file, called as the material calls it.
colour::Illuminant parse_illuminant(JsonReader& json, const ReadNamed& read) {
    const std::string name = json.text("illuminant");
    const std::vector<std::string> names = colour::illuminant_names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return colour::illuminant(name);
    if (!name.ends_with(".csv"))
        json.fail("illuminant", fmt::format("\"{:.40}\"", name),
                  fmt::format("one of {}, or a .csv file beside the material", fmt::join(names, ", ")));
    const NamedText file = read(name);
    colour::Illuminant illuminant = colour::parse_illuminant(file.text, file.file);
    illuminant.name = name;
    return illuminant;
}

MeasuredProbe parse_probe_image(JsonReader json) {
    MeasuredProbe probe{.file = json.text("image")};
    probe.mapping = lighting::parse_mapping(json.choice_or("mapping", "equirect", {"equirect", "angular"}));
    if (probe.file.empty()) json.fail("image", "an empty name", "an .hdr or .exr file");
    json.finish();
    return probe;
}

std::vector<MeasuredProbe> parse_probes(JsonReader& json) {
    const nlohmann::json& list = json.raw("probes");
    if (!list.is_array() || list.empty() || list.size() > kMostProbes)
        json.fail("probes", list.is_array() ? fmt::format("{} probes", list.size()) : "another type",
                  fmt::format("a list of 1 to {} probes", kMostProbes));
    std::vector<MeasuredProbe> probes;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string place = fmt::format("probes/{}", i);
        if (list[i].is_object()) {
            probes.push_back(parse_probe_image(JsonReader(list[i], json.file(), json.pointer_to(place))));
        } else if (list[i].is_string() && !list[i].get<std::string>().empty()) {
            probes.push_back({.file = list[i].get<std::string>()});
        } else {
            json.fail(place, list[i].is_string() ? "an empty name" : "another type",
                      "a probe recipe's name, or { \"image\": \"room.hdr\", \"mapping\": \"equirect\" }");
        }
    }
    return probes;
}

/// What the error of max_error is measured on, where the cooker chooses the representation.
void parse_measure(JsonReader& json, Quality& quality) {
    if (json.has("probes")) quality.probes = parse_probes(json);
    if (json.choice_or("surface", "flat", {"flat", "curved"}) == "curved") quality.surface = SurfaceShape::Curved;
}

}  // namespace

Quality parse_quality(JsonReader json, const Grating& grating, const ReadNamed& read) {
    Quality quality;
    quality.max_error = json.number_or("max_error", quality.max_error, {.minimum = 0.0, .minimum_open = true});
    if (json.has("illuminant")) quality.illuminant = parse_illuminant(json, read);
    if (json.has("representation")) {
        quality.pinned = parse_representation(json, grating);
        quality.key_lights = json.boolean_or("key_lights", takes_key_lights(*quality.pinned));
        if (!quality.key_lights && needs_key_lights(*quality.pinned))
            json.fail("key_lights", "false", "true with this representation", "or leave it out");
        if (has_separate_lights(quality)) quality.lights_at_vertices = at_vertices(json, "lights_at");
        if (is_map(*quality.pinned)) quality.map_at_vertices = at_vertices(json, "map_at");
    } else {
        parse_measure(json, quality);
    }
    json.finish();
    return quality;
}

}  // namespace rowland::diffraction
