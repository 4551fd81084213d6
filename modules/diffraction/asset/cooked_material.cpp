#include "modules/diffraction/asset/cooked_material.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/asset/container.h"
#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/layer_weights.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

CookedMaterial cook_material(const nlohmann::json& json, const std::string& file) {
    CookedMaterial cooked;
    cooked.material = parse_material(json, file);
    if (cooked.material.grating.grooves < kManyGrooves)
        refuse_input(file, "/grating/grooves", fmt::format("{}", cooked.material.grating.grooves),
                     fmt::format("at least {} for a baked material", kManyGrooves),
                     "only rowland-trade's method \"reference\" takes fewer");
    cooked.table = bake_spike_table(cooked.material.grating, table_settings(cooked.material));
    return cooked;
}

std::vector<std::byte> write_cooked_material(const nlohmann::json& json, const CookedMaterial& cooked) {
    ByteWriter writer;
    writer.text(json.dump());
    write_spike_table(cooked.table, writer);
    return writer.take();
}

CookedMaterial read_cooked_material(std::span<const std::byte> payload, const std::string& file) {
    ByteReader reader(payload, file);
    CookedMaterial cooked;
    cooked.material = parse_material(parse_json(reader.text(), file), file);
    cooked.table = read_spike_table(reader);
    if (reader.remaining() != 0) reader.fail(fmt::format("{} bytes too many", reader.remaining()), "the end");
    return cooked;
}

CookedMaterial load_cooked_material(const std::filesystem::path& path) {
    return read_cooked_material(asset::load(path, kMaterialAssetType, kMaterialAssetVersion).payload, path.string());
}

std::string describe(const CookedMaterial& cooked) {
    const Grating& grating = cooked.material.grating;
    const SpikeTable& table = cooked.table;
    const LayerWeights weights = layer_weights(grating);
    std::string text;
    const auto line = [&text](const char* name, const std::string& value) {
        text += fmt::format("{}: {}\n", name, value);
    };
    line("pitch_nm", fmt::format("{}", grating.pitch_nm));
    line("orders", fmt::format("{}", fmt::join(grating.orders, " ")));
    line("representation", "spikes");
    line("bands", fmt::format("{}", table.bands));
    line("spikes", fmt::format("{}", table.spikes));
    line("view_mapping", "spherical");
    line("view_table", fmt::format("{} x {} x {} layers", table.phi_nodes, table.theta_nodes, table.layers()));
    line("storage", table.storage == Storage::Unorm16 ? "unorm16" : "fp16");
    line("table_bytes", fmt::format("{}", table.texels.size() * sizeof(table.texels[0])));
    line("fetches_per_vertex", fmt::format("{}", table.layers()));
    line("multiply_adds_per_vertex",
         fmt::format("{}", table.layers() * 4 + table.spikes * table.bands * table.bands * 3));
    line("zero_order_luminance", fmt::format("{:.4f}", weights.mirror.y));
    line("base_luminance", fmt::format("{:.4f}", weights.base.y));
    return text;
}

}  // namespace rowland::diffraction
