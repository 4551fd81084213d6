#include "modules/diffraction/representations/representation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

constexpr int kFetchesPerLight = 2;  ///< of the lobe's table, for a pixel narrower than the lobe
/// Counted in key_light_tables.glsl and kernel.glsl for the flat lobe: position 25, height 45, sum 15.
constexpr int kMultiplyAddsPerLight = 85;

/// Calls use<Settings>(index) for every representation.
template <typename Use>
void for_each_representation(const Use& use) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (use.template operator()<std::variant_alternative_t<I, Representation>>(I), ...);
    }
    (std::make_index_sequence<kRepresentationCount>());
}

bool mirrors(const GrooveLobe& lobe) {
    const auto* pits = std::get_if<PitsLobe>(&lobe);
    return std::holds_alternative<GaussianLobe>(lobe) || (pits != nullptr && pits->coherent > 0.0);
}

/// The words for a lobe that does not mirror.
const char* words_for(const GrooveLobe& lobe) {
    if (is_flat(lobe)) return "a groove_lobe that is flat";
    return std::holds_alternative<PitSequenceLobe>(lobe) ? "a pit_sequence, whose orders lie in many directions"
                                                         : "pits that have no coherent part";
}

/// Quoted names of the representations for `lobes`, separated by commas.
std::string names_for(Lobes lobes) {
    std::string names;
    for (const RepresentationInfo* info : representations())
        if (info->lobes == lobes) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", info->name);
    return names;
}

/// Refuses a lattice for representations of grooves, which tabulate functions of u_g alone.
std::optional<Refusal> lattice_refusal(const RepresentationInfo& info, const Grating& grating) {
    if (!grating.lattice || info.lattices) return std::nullopt;
    std::string names;
    for (const RepresentationInfo* other : representations())
        if (other->lattices) names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", other->name);
    return Refusal{"representation", fmt::format("\"{}\" with a lattice", info.name), names,
                   "the others shade grooves of one direction"};
}

std::optional<Refusal> lobe_refusal(const RepresentationInfo& info, const Grating& grating) {
    const GrooveLobe& lobe = grating.lobe;
    if (info.lobes == Lobes::Mirroring && depends_on_direction(grating))
        return Refusal{"representation", fmt::format("\"{}\" with efficiencies of directions", info.name),
                       names_for(Lobes::Any), "or \"theory\": \"scalar\""};
    if (info.lobes == Lobes::Flat && !is_flat(lobe))
        return Refusal{"representation", fmt::format("\"{}\" with a groove_lobe that is not flat", info.name),
                       fmt::format("{} or, for narrow lobes, {}", names_for(Lobes::Any), names_for(Lobes::Mirroring)),
                       "or make groove_lobe \"flat\""};
    if (info.lobes == Lobes::Mirroring && !mirrors(lobe))
        return Refusal{"representation", fmt::format("\"{}\" with {}", info.name, words_for(lobe)),
                       "a groove_lobe with a sigma, or with pits and a coherent part",
                       fmt::format("{} take any lobe", names_for(Lobes::Any))};
    return std::nullopt;
}

}  // namespace

const std::array<const RepresentationInfo*, kRepresentationCount>& representations() {
    static const auto all = [] {
        std::array<const RepresentationInfo*, kRepresentationCount> infos{};
        for_each_representation([&]<typename Settings>(std::size_t i) { infos[i] = &Settings::info(); });
        return infos;
    }();
    return all;
}

const RepresentationInfo& info(const Representation& representation) {
    return *representations()[representation.index()];
}

const RepresentationInfo& info(const BakedTables& tables) {
    return *representations()[tables.index()];
}

const RepresentationInfo* find_representation(std::string_view name) {
    const auto& all = representations();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto* info) { return info->name == name; });
    return found != all.end() ? *found : nullptr;
}

std::optional<Refusal> baked_refusal(const Grating& grating) {
    if (grating.grooves >= kManyGrooves) return std::nullopt;
    return Refusal{"/grating/grooves", fmt::format("{}", grating.grooves),
                   fmt::format("at least {} for a baked material", kManyGrooves),
                   "only rowland-trade's method \"reference\" takes fewer"};
}

std::optional<Refusal> refusal(const RepresentationInfo& info, const SettingValues& values, const Grating& grating) {
    if (auto refused = lattice_refusal(info, grating)) return refused;
    if (auto refused = lobe_refusal(info, grating); refused && !grating.lattice) return refused;
    std::optional<Refusal> refused;
    for_each_representation([&]<typename Settings>(std::size_t) {
        if constexpr (requires { Settings::refusal(values, grating); })
            if (&Settings::info() == &info) refused = Settings::refusal(values, grating);
    });
    return refused;
}

Representation make_representation(const RepresentationInfo& info, const SettingValues& values,
                                   const Grating& grating) {
    std::optional<Representation> made;
    for_each_representation([&]<typename Settings>(std::size_t) {
        if (&Settings::info() == &info) made = Settings::from(values, grating);
    });
    ROWLAND_CHECK(made.has_value(), info.name);
    return *std::move(made);
}

void set_illuminant(Representation& representation, const colour::Illuminant& illuminant) {
    std::visit(
        [&](auto& settings) {
            if constexpr (requires { settings.illuminant; })
                settings.illuminant = illuminant;
            else if constexpr (requires { settings.set_illuminant(illuminant); })
                settings.set_illuminant(illuminant);
        },
        representation);
}

BakedTables bake_tables(const Grating& grating, const Representation& representation) {
    return std::visit([&](const auto& settings) -> BakedTables { return bake(grating, settings); }, representation);
}

void write_tables(const BakedTables& tables, ByteWriter& writer) {
    writer.value(info(tables).file_number);
    std::visit([&](const auto& table) { write(table, writer); }, tables);
}

BakedTables read_tables(ByteReader& reader, const Representation& expected) {
    const auto number = reader.value<std::uint8_t>();
    if (const RepresentationInfo& wanted = info(expected); number != wanted.file_number)
        reader.fail(fmt::format("representation {}", number),
                    fmt::format("{} ({}), which the material asks for; cook the material again", wanted.file_number,
                                wanted.name));
    return std::visit([&](const auto& settings) -> BakedTables { return read(reader, settings); }, expected);
}

ShadingCost shading_cost(const BakedTables& tables, bool map_at_vertices) {
    ShadingCost total = std::visit([](const auto& table) { return cost(table); }, tables);
    if (map_at_vertices) {
        total.fetches_per_vertex += std::exchange(total.fetches_per_pixel, 0);
        total.multiply_adds_per_vertex += std::exchange(total.multiply_adds_per_pixel, 0);
    }
    total.fetches_per_light = kFetchesPerLight;
    total.multiply_adds_per_light = kMultiplyAddsPerLight;
    return total;
}

}  // namespace rowland::diffraction
