#include "editor/trade/report.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "editor/trade/embedded_files.h"
#include "editor/trade/other_load.h"
#include "editor/trade/pareto.h"
#include "editor/trade/source_versions.h"
#include "editor/trade/sweep_plan.h"
#include "editor/trade/sweep_tables.h"
#include "engine/core/check.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::trade {

namespace {

constexpr std::size_t kDiscVertices = 25000;
constexpr const char* kDataMark = "/*DATA*/";

nlohmann::ordered_json representation_names() {
    nlohmann::ordered_json names;
    for (const auto* info : diffraction::representations()) names.push_back(info->name);
    return names;
}

/// A row of the sweep's table, with "memory": its tables and the disc's light; and "paper" if it is the paper's.
nlohmann::ordered_json panel_row(const SweepResults& results, const ErrorRow& error) {
    const CostRow& cost = cost_of(results, error);
    nlohmann::ordered_json row = sweep_row(results, error);
    row["memory"] = cost.cost.table_bytes + cost.cost.vertex_bytes * kDiscVertices;
    if (results.settings[error.material][error.setting] == paper_setting()) row["paper"] = true;
    return row;
}

void mark_front(const char* cost, const char* mark, nlohmann::ordered_json& rows) {
    std::vector<TradePoint> points;
    for (const auto& row : rows)
        points.push_back({row[cost].is_null() ? std::numeric_limits<double>::infinity() : row[cost].get<double>(),
                          row["relative_rms"].get<double>()});
    for (const std::size_t i : pareto_front(points)) rows[i][mark] = true;
}

/// A material file for the page in a browser, which chooses representations itself; null if it names another file.
nlohmann::json browser_material(const std::filesystem::path& path) {
    nlohmann::json json = diffraction::load_material_json(path);
    const diffraction::Material material = diffraction::parse_material(json, path.string());
    if (std::holds_alternative<diffraction::EfficiencyTable>(material.grating.profile)) return nullptr;
    json.erase("quality");
    return json;
}

nlohmann::ordered_json panels(const SweepResults& results, const SweepInputs& inputs) {
    std::vector<nlohmann::json> materials(results.materials.size());
    std::ranges::transform(inputs.materials, materials.begin(), browser_material);
    std::map<std::tuple<std::size_t, std::size_t, std::string>, nlohmann::ordered_json> panels;
    std::vector<std::tuple<std::size_t, std::size_t, std::string>> order;  // sets as they were measured
    for (const ErrorRow& error : results.errors) {
        const auto key = std::tuple(error.material, error.probe, error.set);
        if (!panels.contains(key)) order.push_back(key);
        panels[key].push_back(panel_row(results, error));
    }
    std::ranges::stable_sort(order, {}, [](const auto& key) { return std::pair(std::get<0>(key), std::get<1>(key)); });
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& key : order) {
        const auto& [material, probe, set] = key;
        mark_front("frame_ratio", "front_speed", panels[key]);
        mark_front("memory", "front_memory", panels[key]);
        list.push_back({{"material", results.materials[material]},
                        {"probe", results.probes[probe]},
                        {"set", set},
                        {"browser_material", materials[material]},
                        {"rows", panels[key]}});
    }
    return list;
}

nlohmann::ordered_json probes(const SweepResults& results, const std::vector<ProbeStatistics>& statistics) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < statistics.size(); ++i) {
        const ProbeStatistics& probe = statistics[i];
        list.push_back({{"name", results.probes[i]},
                        {"size", {probe.width, probe.height}},
                        {"mean", probe.mean},
                        {"peak_over_mean", probe.peak_over_mean},
                        {"brightest_fraction", probe.brightest_fraction}});
    }
    return list;
}

nlohmann::ordered_json films(const SweepResults& results, const std::vector<std::vector<FilmRow>>& of_probes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t probe = 0; probe < of_probes.size(); ++probe)
        for (const FilmRow& row : of_probes[probe])
            list.push_back({{"probe", results.probes[probe]},
                            {"film", row.film},
                            {"roughness", row.roughness},
                            {"method", row.method},
                            {"relative_rms", row.relative_rms},
                            {"table_bytes", row.table_bytes},
                            {"fetches", row.fetches},
                            {"multiply_adds", row.multiply_adds},
                            {"functions", row.functions}});
    return list;
}

}  // namespace

std::vector<std::size_t> pictured_settings(const SweepResults& results, std::size_t material, std::size_t probe) {
    const ErrorRow* best = nullptr;
    for (const ErrorRow& row : results.errors) {
        if (row.material != material || row.probe != probe || row.set != "picture") continue;
        const CostRow& cost = cost_of(results, row);
        if (cost.time && cost.time->ratio() > kRealTimeRatio) continue;
        if (best == nullptr || row.error.relative_rms < best->error.relative_rms) best = &row;
    }
    std::vector<std::size_t> settings = {0};
    if (best != nullptr && best->setting != 0) settings.insert(settings.begin(), best->setting);
    return settings;
}

nlohmann::ordered_json report_data(const SweepResults& results, const SweepInputs& inputs,
                                   const std::vector<DifferencePicture>& differences,
                                   const nlohmann::ordered_json& paper, const ReportOrigin& origin) {
    nlohmann::ordered_json json = {{"date", origin.date},
                                   {"command", origin.command},
                                   {"version", release_version() + ", " + method_version().substr(0, 8)},
                                   {"probes", probes(results, origin.probes)},
                                   {"loaded", kLoaded},
                                   {"loaded_times", results.loaded_times()},
                                   {"device", results.device},
                                   {"frame_size", {inputs.frame_size.x, inputs.frame_size.y}},
                                   {"vertices", kDiscVertices},
                                   {"real_time_ratio", kRealTimeRatio},
                                   {"full_difference", kFullDifference},
                                   {"representations", representation_names()},
                                   {"panels", panels(results, inputs)},
                                   {"differences", nlohmann::ordered_json::array()},
                                   {"films", films(results, origin.films)},
                                   {"paper", paper}};
    for (const DifferencePicture& difference : differences)
        json["differences"].push_back(
            {{"group", results.materials[difference.material] + " under " + results.probes[difference.probe]},
             {"setting", difference.setting},
             {"error", difference.error.relative_rms},
             {"flip", difference.error.flip.value_or(0.0)},
             {"image", data_url(difference.picture)}});
    return json;
}

std::string report_html(const nlohmann::ordered_json& data) {
    std::string page(report_files().front().text);
    std::string text = data.dump();
    // Nothing in the data may end the script element that holds it.
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    const std::size_t mark = page.find(kDataMark);
    ROWLAND_CHECK(mark != std::string::npos, "the template has a mark for the data");
    return page.replace(mark, std::string(kDataMark).size(), text);
}

}  // namespace rowland::trade
