#include "editor/trade/sweep_tables.h"

#include <algorithm>
#include <array>

#include "engine/core/check.h"

namespace rowland::trade {

namespace {

constexpr std::array kSettingColumns = {"bands",        "spikes",          "bins",    "rank",  "map_resolution",
                                        "view_mapping", "view_resolution", "storage", "nodes", "taps"};

constexpr std::array kColumns = {"material",
                                 "probe",
                                 "set",
                                 "setting",
                                 "representation",
                                 "bands",
                                 "spikes",
                                 "bins",
                                 "rank",
                                 "map_resolution",
                                 "view_mapping",
                                 "view_resolution",
                                 "storage",
                                 "nodes",
                                 "taps",
                                 "key_lights",
                                 "window",
                                 "relative_rms",
                                 "largest",
                                 "dark_absolute",
                                 "median_delta_e",
                                 "p95_delta_e",
                                 "frame_ms",
                                 "plain_ms",
                                 "frame_ratio",
                                 "fetches_per_vertex",
                                 "multiply_adds_per_vertex",
                                 "fetches_per_pixel",
                                 "multiply_adds_per_pixel",
                                 "fetches_per_light",
                                 "table_bytes",
                                 "vertex_bytes"};

/// A field of a table with commas (RFC 4180).
std::string csv_field(std::string text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return '"' + text + '"';
}

}  // namespace

const CostRow& cost_of(const SweepResults& results, const ErrorRow& row) {
    const auto found = std::find_if(results.costs.begin(), results.costs.end(), [&](const CostRow& cost) {
        return cost.material == row.material && cost.setting == row.setting;
    });
    ROWLAND_CHECK(found != results.costs.end(), "every setting has its cost");
    return *found;
}

nlohmann::ordered_json sweep_row(const SweepResults& results, const ErrorRow& row) {
    const Setting& setting = results.settings[row.material][row.setting];
    nlohmann::ordered_json json;
    json["material"] = results.materials[row.material];
    json["probe"] = results.probes[row.probe];
    json["set"] = row.set;
    json["setting"] = setting_name(setting);
    json["representation"] = representation_of(setting);
    for (const char* key : kSettingColumns)
        if (setting.quality.contains(key)) json[key] = setting.quality[key];
    json["key_lights"] = setting.key_lights;
    json["window"] = math::window_name(setting.window);
    json["relative_rms"] = row.error.relative_rms;
    json["largest"] = row.error.largest;
    json["dark_absolute"] = row.error.dark_absolute;
    json["median_delta_e"] = row.error.median_delta_e;
    json["p95_delta_e"] = row.error.high_delta_e;
    const CostRow& cost = cost_of(results, row);
    if (cost.time) {
        json["frame_ms"] = cost.time->ms;
        json["plain_ms"] = cost.time->plain_ms;
        json["frame_ratio"] = cost.time->ratio();
    }
    json["fetches_per_vertex"] = cost.cost.fetches_per_vertex;
    json["multiply_adds_per_vertex"] = cost.cost.multiply_adds_per_vertex;
    json["fetches_per_pixel"] = cost.cost.fetches_per_pixel;
    json["multiply_adds_per_pixel"] = cost.cost.multiply_adds_per_pixel;
    json["fetches_per_light"] = cost.cost.fetches_per_light;
    json["table_bytes"] = cost.cost.table_bytes;
    json["vertex_bytes"] = cost.vertex_bytes;
    return json;
}

std::string sweep_csv(const SweepResults& results) {
    std::string text;
    for (const char* column : kColumns) text += std::string(text.empty() ? "" : ",") + column;
    text += '\n';
    for (const ErrorRow& row : results.errors) {
        const nlohmann::ordered_json json = sweep_row(results, row);
        std::string line;
        for (const char* column : kColumns) {
            if (!line.empty()) line += ',';
            if (!json.contains(column)) continue;
            line += json[column].is_string() ? csv_field(json[column].get<std::string>()) : json[column].dump();
        }
        text += line + '\n';
    }
    return text;
}

std::string sweep_json_lines(const SweepResults& results) {
    std::string text;
    for (const ErrorRow& row : results.errors) text += sweep_row(results, row).dump() + '\n';
    return text;
}

}  // namespace rowland::trade
