#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/circle/circle.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/representations/planar/planar.h"
#include "modules/diffraction/representations/spikes/spikes.h"
#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

/// How a material is shaded (PHYSICS §6). The order equals that of BakedTables.
///
/// Each alternative has the static members info() and from() (the settings for a grating). Optional members: the static
/// refusal() (why the settings do not suit a grating), and `illuminant` or set_illuminant() where the light's white is
/// baked in.
using Representation = std::variant<SpikeTableSettings, ArcSettings, DirectSettings, PlanarSettings, CircleSettings,
                                    StreakSurfaceSettings>;

/// The baked tables of each representation. These overloads must exist for every alternative: bake(), write(), read(),
/// cost(), facts() and point_shader().
using BakedTables = std::variant<SpikeTable, ArcTable, DirectTables, PlanarTables, CircleTables, StreakTables>;
inline constexpr std::size_t kRepresentationCount = std::variant_size_v<Representation>;
static_assert(kRepresentationCount == std::variant_size_v<BakedTables>);

/// In the order of the variants.
const std::array<const RepresentationInfo*, kRepresentationCount>& representations();
const RepresentationInfo& info(const Representation& representation);
const RepresentationInfo& info(const BakedTables& tables);
/// Null if no representation has this name.
const RepresentationInfo* find_representation(std::string_view name);

/// Why a representation with these settings cannot shade a grating; nullopt if it can. The parser, budgets, sweeps,
/// editors and programs all use this function.
std::optional<Refusal> refusal(const RepresentationInfo& info, const SettingValues& values, const Grating& grating);
/// Why no representation can be baked for a grating: it has fewer than kManyGrooves grooves, which only the reference
/// supports. A material file may have them.
std::optional<Refusal> baked_refusal(const Grating& grating);
/// The settings for a grating. refusal() must be nullopt for them.
Representation make_representation(const RepresentationInfo& info, const SettingValues& values, const Grating& grating);

/// Sets the spectrum of the light's white in settings that have one.
void set_illuminant(Representation& representation, const colour::Illuminant& illuminant);

/// Throws Error (input) if the representation does not suit the grating.
BakedTables bake_tables(const Grating& grating, const Representation& representation);

/// Writes the representation's number, then its tables.
void write_tables(const BakedTables& tables, ByteWriter& writer);
/// Throws Error (input) if the bytes are not tables of the representation `expected`.
BakedTables read_tables(ByteReader& reader, const Representation& expected);

/// `map_at_vertices`: see Quality.
ShadingCost shading_cost(const BakedTables& tables, bool map_at_vertices = false);

}  // namespace rowland::diffraction
