#include "modules/diffraction/asset/representation.h"

#include <array>
#include <utility>

namespace rowland::diffraction {

namespace {

constexpr int kFetchesPerLight = 2;  ///< of the lobe's table, at either side of a pixel that is narrower than the lobe
/// Counted in key_lobes.glsl and light_spot.glsl for the flat lobe: 25 for the place, 45 for the height, 15 for the
/// sum.
constexpr int kMultiplyAddsPerLight = 85;
constexpr std::size_t kHalfTexel = 8;

int squared(int n) {
    return n * n;
}

ShadingCost cost_of(const SpikeTable& table) {
    return {.fetches_per_vertex = table.layers() + 3 * table.spikes,
            .multiply_adds_per_vertex = 4 * table.layers() + 3 * table.spikes * squared(table.bands) + 9 * table.spikes,
            .table_bytes = table.bytes()};
}

ShadingCost cost_of(const BinTable& table) {
    const int layers = table.bins() * transfer_layers(table.bands);
    return {.fetches_per_vertex = layers,
            .multiply_adds_per_vertex = 4 * layers + 3 * table.bins() * squared(table.bands) + 9 * table.bins(),
            .table_bytes = table.bytes()};
}

ShadingCost cost_of(const TransferTable& table) {
    const int layers = 9 * transfer_layers(table.bands);
    return {.fetches_per_vertex = layers, .multiply_adds_per_vertex = 8 * layers, .table_bytes = table.bytes()};
}

ShadingCost cost_of(const ArcTable& table) {
    const int layers = static_cast<int>(weight_layers(table.rank));
    return {.fetches_per_pixel = layers,
            .multiply_adds_per_pixel = (4 + 12) * layers,
            .table_bytes = table.bytes() + table.factors.size() * sizeof(glm::mat3)};
}

ShadingCost cost_of(const DirectTables&) {
    return {};
}

ShadingCost cost_of(const PlanarTables& tables) {
    const std::size_t texels =
        static_cast<std::size_t>(tables.size.azimuths) * static_cast<std::size_t>(tables.size.views);
    return {.fetches_per_pixel = 1,
            .multiply_adds_per_pixel = 12,
            .table_bytes = texels * kHalfTexel + cost_of(tables.stand_in).table_bytes};
}

ShadingCost cost_of(const CircleTables& tables) {
    const std::size_t columns = static_cast<std::size_t>(squared(tables.size.side));
    return {.fetches_per_pixel = tables.size.terms,
            .multiply_adds_per_pixel = 3 * tables.size.terms + 40,
            .table_bytes = 2 * columns * static_cast<std::size_t>(tables.size.views) *
                           static_cast<std::size_t>(tables.size.terms) * kHalfTexel};
}

ShadingCost cost_of(const StreakTables& tables) {
    constexpr std::size_t kNodeBytes = 64;
    const int taps = most_seen_nodes(tables.streak) * tables.taps;
    ShadingCost cost = tables.rest ? cost_of(*tables.rest) : ShadingCost{};
    cost.fetches_per_pixel += kStreakFilterTaps * taps;
    cost.multiply_adds_per_pixel +=
        taps * (40 + 6 * kStreakFilterTaps) + 12 * static_cast<int>(tables.streak.nodes.size());
    cost.table_bytes += tables.streak.nodes.size() * kNodeBytes;
    return cost;
}

void set(SpikeTableSettings& settings, const colour::Illuminant& illuminant) {
    settings.spikes.illuminant = illuminant;
}
void set(BinSettings& settings, const colour::Illuminant& illuminant) {
    settings.illuminant = illuminant;
}
void set(TransferSettings& settings, const colour::Illuminant& illuminant) {
    settings.illuminant = illuminant;
}
void set(ArcSettings& settings, const colour::Illuminant& illuminant) {
    settings.illuminant = illuminant;
}
void set(PlanarSettings& settings, const colour::Illuminant& illuminant) {
    settings.stand_in.illuminant = illuminant;
}
void set(StreakSurfaceSettings& settings, const colour::Illuminant& illuminant) {
    settings.streak.illuminant = illuminant;
    if (settings.rest) settings.rest->illuminant = illuminant;
}
void set(DirectSettings&, const colour::Illuminant&) {}
void set(CircleSettings&, const colour::Illuminant&) {}

}  // namespace

void set_illuminant(Representation& representation, const colour::Illuminant& illuminant) {
    std::visit([&](auto& settings) { set(settings, illuminant); }, representation);
}

const char* representation_name(std::size_t index) {
    constexpr std::array<const char*, std::variant_size_v<Representation>> kNames{
        "spikes", "bins", "transfer", "arc", "direct", "planar", "circle", "streak"};
    return kNames.at(index);
}

ShadingCost shading_cost(const BakedTables& tables, bool map_at_vertices) {
    ShadingCost cost = std::visit([](const auto& table) { return cost_of(table); }, tables);
    if (map_at_vertices) {
        cost.fetches_per_vertex += std::exchange(cost.fetches_per_pixel, 0);
        cost.multiply_adds_per_vertex += std::exchange(cost.multiply_adds_per_pixel, 0);
    }
    cost.fetches_per_light = kFetchesPerLight;
    cost.multiply_adds_per_light = kMultiplyAddsPerLight;
    return cost;
}

}  // namespace rowland::diffraction
