#pragma once

#include <cstddef>
#include <optional>
#include <variant>

#include "modules/diffraction/bake/arc_table.h"
#include "modules/diffraction/bake/bin_table.h"
#include "modules/diffraction/bake/circle_map.h"
#include "modules/diffraction/bake/planar_map.h"
#include "modules/diffraction/bake/spike_table.h"
#include "modules/diffraction/bake/streak.h"
#include "modules/diffraction/bake/transfer_table.h"

namespace rowland::diffraction {

/// Only lights of their own are shaded: the probe's key lights and the scene's.
struct DirectSettings {};

/// The map over (azimuth, v_g) that a flat object's light fills at run time, and what shades it while it fills and on
/// objects that are not flat.
struct PlanarSettings {
    PlanarMapSize size;
    ArcSettings stand_in;
};

/// The map over (g, v_g) that the probe fills at run time.
struct CircleSettings {
    CircleMapSize size;
};

/// Narrow lobes mirror the whole probe along the grooves; what they leave of Stam's pits is an arc table's.
struct StreakSurfaceSettings {
    StreakSettings streak;
    int taps = 3;                       ///< places across the lobe, 1 to kMostStreakTaps
    std::optional<ArcSettings> rest{};  ///< where incoherent_rest() is something
};
inline constexpr int kMostStreakTaps = 9;
/// The most places along a tap's longer side that are read.
inline constexpr int kStreakFilterTaps = 2;

/// How a material is shaded (PHYSICS §6), with what it costs and what it loses. The order is that of BakedTables and of
/// the numbers in cooked files.
using Representation = std::variant<SpikeTableSettings, BinSettings, TransferSettings, ArcSettings, DirectSettings,
                                    PlanarSettings, CircleSettings, StreakSurfaceSettings>;

/// Sets the spectrum of the light's white in all settings that know one.
void set_illuminant(Representation& representation, const colour::Illuminant& illuminant);

/// What was baked for a DirectSettings: nothing besides the kernel, which all have.
struct DirectTables {};

struct PlanarTables {
    PlanarMapSize size;
    ArcTable stand_in;
};

struct CircleTables {
    CircleMapSize size;
};

struct StreakTables {
    Streak streak;
    int taps = 3;
    std::optional<ArcTable> rest{};  ///< to be weighed with 1 − streak.share
};

using BakedTables =
    std::variant<SpikeTable, BinTable, TransferTable, ArcTable, DirectTables, PlanarTables, CircleTables, StreakTables>;
static_assert(std::variant_size_v<Representation> == std::variant_size_v<BakedTables>);

/// "spikes", "bins", …: the name in material files of a Representation's or BakedTables' index().
const char* representation_name(std::size_t index);

/// What shading costs, as counts that depend on the material alone. Texels are counted as fetches of four components.
struct ShadingCost {
    int fetches_per_vertex = 0;
    int multiply_adds_per_vertex = 0;
    int fetches_per_pixel = 0;        ///< without lights of their own
    int multiply_adds_per_pixel = 0;  ///< likewise
    int fetches_per_light = 0;        ///< per pixel and light that is shaded on its own
    int multiply_adds_per_light = 0;  ///< likewise
    std::size_t table_bytes = 0;      ///< as uploaded; maps that are filled at run time are counted full
};

/// `map_at_vertices`: see Quality.
ShadingCost shading_cost(const BakedTables& tables, bool map_at_vertices = false);

}  // namespace rowland::diffraction
