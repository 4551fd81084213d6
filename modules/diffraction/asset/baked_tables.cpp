#include "modules/diffraction/asset/baked_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace rowland::diffraction {

namespace {

constexpr std::size_t kMostKernelEntries = 1 << 16;
/// Beyond the path differences of all orders that a material may list.
constexpr double kFarthestKernel_nm = 1e9;

BakedTables bake(const Grating& grating, const SpikeTableSettings& settings) {
    return bake_spike_table(grating, settings);
}
BakedTables bake(const Grating& grating, const BinSettings& settings) {
    return bake_bin_table(grating, settings);
}
BakedTables bake(const Grating& grating, const TransferSettings& settings) {
    return bake_transfer_table(grating, settings);
}
BakedTables bake(const Grating& grating, const ArcSettings& settings) {
    return bake_arc_table(grating, settings);
}
BakedTables bake(const Grating&, const DirectSettings&) {
    return DirectTables{};
}
BakedTables bake(const Grating& grating, const PlanarSettings& settings) {
    return PlanarTables{settings.size, bake_arc_table(grating, settings.stand_in)};
}
BakedTables bake(const Grating&, const CircleSettings& settings) {
    return CircleTables{settings.size};
}

BakedTables bake(const Grating& grating, const StreakSurfaceSettings& settings) {
    StreakTables tables{.streak = make_streak(grating, settings.streak), .taps = settings.taps};
    if (settings.rest) tables.rest = bake_arc_table(incoherent_rest(grating).value(), *settings.rest);
    return tables;
}

void write(const SpikeTable& table, ByteWriter& writer) {
    write_spike_table(table, writer);
}
void write(const BinTable& table, ByteWriter& writer) {
    write_bin_table(table, writer);
}
void write(const TransferTable& table, ByteWriter& writer) {
    write_transfer_table(table, writer);
}
void write(const ArcTable& table, ByteWriter& writer) {
    write_arc_table(table, writer);
}
void write(const DirectTables&, ByteWriter&) {}
void write(const PlanarTables& tables, ByteWriter& writer) {
    write_arc_table(tables.stand_in, writer);
}
void write(const CircleTables&, ByteWriter&) {}
void write(const StreakTables& tables, ByteWriter& writer) {
    write_streak(tables.streak, writer);
    if (tables.rest) write_arc_table(*tables.rest, writer);
}

/// The material's own limits are those of shaders and textures, so that a table must be what it asks for.
void require_as_asked(const ByteReader& reader, bool is_so) {
    if (!is_so) reader.fail("a table of other bands, sizes or storage", "the table that the material asks for");
}

ArcTable read_as_asked(ByteReader& reader, const ArcSettings& settings) {
    ArcTable table = read_arc_table(reader);
    require_as_asked(reader, table.bands == settings.bands && table.rank <= settings.rank && !table.pitch &&
                                 (!settings.grid || table.grid == *settings.grid) && table.storage == settings.storage);
    return table;
}

BakedTables read(ByteReader& reader, const SpikeTableSettings& settings) {
    SpikeTable table = read_spike_table(reader);
    const ViewGrid grid{.mapping = settings.mapping, .columns = settings.phi_nodes, .rows = settings.theta_nodes};
    require_as_asked(reader, table.bands == settings.spikes.bands && table.spikes == settings.spikes.spikes &&
                                 table.grid() == grid && table.storage == settings.storage);
    return table;
}
BakedTables read(ByteReader& reader, const BinSettings& settings) {
    BinTable table = read_bin_table(reader);
    require_as_asked(reader, table.bands == settings.bands && table.bins() == settings.bins &&
                                 table.grid == settings.grid && table.storage == settings.storage);
    return table;
}
BakedTables read(ByteReader& reader, const TransferSettings& settings) {
    TransferTable table = read_transfer_table(reader);
    require_as_asked(reader, table.bands == settings.bands && (!settings.grid || table.grid == *settings.grid) &&
                                 table.storage == settings.storage);
    return table;
}
BakedTables read(ByteReader& reader, const ArcSettings& settings) {
    return read_as_asked(reader, settings);
}
BakedTables read(ByteReader&, const DirectSettings&) {
    return DirectTables{};
}
/// The map's size comes from the material, where it has been checked.
BakedTables read(ByteReader& reader, const PlanarSettings& settings) {
    return PlanarTables{settings.size, read_as_asked(reader, settings.stand_in)};
}
BakedTables read(ByteReader&, const CircleSettings& settings) {
    return CircleTables{settings.size};
}
BakedTables read(ByteReader& reader, const StreakSurfaceSettings& settings) {
    StreakTables tables{.streak = read_streak(reader), .taps = settings.taps};
    if (settings.rest) tables.rest = read_as_asked(reader, *settings.rest);
    return tables;
}

}  // namespace

BakedTables bake_tables(const Grating& grating, const Representation& representation) {
    return std::visit([&](const auto& settings) { return bake(grating, settings); }, representation);
}

void write_tables(const BakedTables& tables, ByteWriter& writer) {
    writer.value(static_cast<std::uint8_t>(tables.index()));
    std::visit([&](const auto& table) { write(table, writer); }, tables);
}

BakedTables read_tables(ByteReader& reader, const Representation& expected) {
    const auto index = reader.value<std::uint8_t>();
    if (index != expected.index())
        reader.fail(fmt::format("representation {}", index),
                    fmt::format("{} ({}), which the material asks for", expected.index(),
                                representation_name(expected.index())));
    return std::visit([&](const auto& settings) { return read(reader, settings); }, expected);
}

void write_kernel(const KernelTable& kernel, ByteWriter& writer) {
    writer.value(kernel.begin_nm);
    writer.value(kernel.end_nm);
    writer.value(kernel.error);
    write_matrices(kernel.antiderivative, writer);
}

KernelTable read_kernel(ByteReader& reader) {
    KernelTable kernel;
    kernel.begin_nm = reader.value<double>();
    kernel.end_nm = reader.value<double>();
    kernel.error = reader.value<double>();
    // Written so that a NaN fails.
    if (!(kernel.begin_nm >= -kFarthestKernel_nm && kernel.begin_nm <= kernel.end_nm &&
          kernel.end_nm <= kFarthestKernel_nm && std::isfinite(kernel.error)))
        reader.fail(fmt::format("a kernel from {} to {} nm", kernel.begin_nm, kernel.end_nm),
                    fmt::format("an ascending interval within {} nm", kFarthestKernel_nm));
    kernel.antiderivative = read_matrices(reader, "kernel entries", 2, kMostKernelEntries);
    return kernel;
}

}  // namespace rowland::diffraction
