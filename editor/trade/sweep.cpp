#include "editor/trade/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "editor/trade/inputs.h"
#include "editor/trade/source_versions.h"
#include "editor/trade/sweep_plan.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/hash.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/core/utf8.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::trade {

namespace {

constexpr std::uint64_t kLargestMaterial = 1 << 20;
constexpr std::uint64_t kLargestProbe = std::uint64_t{1} << 31;
constexpr int kMostBands = 16;               ///< of a material's light
constexpr std::size_t kReferenceChunk = 60;  ///< points that are lost if the program is killed

std::string hash_of_file(const std::filesystem::path& path, std::uint64_t largest, const std::string& with) {
    return Hasher().bytes(read_file(path, largest)).text(with).digest().hex();
}

/// Files that a material names are part of it.
void hash_named_files(const nlohmann::json& json, const std::filesystem::path& folder, Hasher& hasher) {
    if (json.is_structured()) {
        for (const nlohmann::json& value : json) hash_named_files(value, folder, hasher);
    } else if (json.is_string() && json.get<std::string>().ends_with(".csv")) {
        hasher.bytes(read_file(folder / json.get<std::string>(), diffraction::kMaximumNamedFileSize));
    }
}

/// The quality is the setting's, but for the light's spectrum.
std::string material_hash(nlohmann::json json, const std::filesystem::path& path) {
    std::string illuminant;
    if (json.contains("quality")) illuminant = json["quality"].value("illuminant", "");
    json.erase("quality");
    Hasher hasher;
    hasher.text(json.dump()).text(illuminant);
    hash_named_files(json, path.parent_path(), hasher);
    return hasher.digest().hex();
}

std::string hash_of(std::span<const diffraction::Frame> frames) {
    return Hasher().bytes(std::as_bytes(frames)).digest().hex();
}

std::string key_of(std::initializer_list<std::string> parts) {
    Hasher hasher;
    for (const std::string& part : parts) hasher.text(part);
    return hasher.digest().hex();
}

nlohmann::json to_json(std::span<const glm::dvec3> values) {
    nlohmann::json json = nlohmann::json::array();
    for (const glm::dvec3& value : values) json.push_back({value.x, value.y, value.z});
    return json;
}

std::vector<glm::dvec3> to_vectors(const nlohmann::json& json) {
    std::vector<glm::dvec3> values;
    for (const nlohmann::json& value : json)
        values.emplace_back(value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>());
    return values;
}

nlohmann::json to_json(const MethodError& error) {
    return {{"relative_rms", error.relative_rms},
            {"largest", error.largest},
            {"dark_absolute", error.dark_absolute},
            {"median_delta_e", error.median_delta_e},
            {"p95_delta_e", error.high_delta_e}};
}

MethodError to_error(const nlohmann::json& json) {
    return {.relative_rms = json.at("relative_rms"),
            .largest = json.at("largest"),
            .dark_absolute = json.at("dark_absolute"),
            .median_delta_e = json.at("median_delta_e"),
            .high_delta_e = json.at("p95_delta_e")};
}

std::vector<std::string> stems(const std::vector<std::filesystem::path>& paths) {
    std::vector<std::string> names;
    for (const auto& path : paths) {
        const std::string stem = valid_utf8(path.stem().string());
        const auto same = std::count_if(names.begin(), names.end(), [&](const std::string& name) {
            return name == stem || name.starts_with(stem + "#");
        });
        names.push_back(same == 0 ? stem : fmt::format("{}#{}", stem, same + 1));
    }
    return names;
}

/// A plane's map shades no curved surface; what stands in for it there is a setting of its own.
bool applies(const Setting& setting, const FrameSet& set) {
    return representation_of(setting) != "planar" || std::any_of(set.surfaces.begin(), set.surfaces.end(), is_flat);
}

/// Windows change no time: two settings that differ in nothing else are timed once.
Setting without_window(Setting setting) {
    setting.window = math::SphericalWindow::None;
    return setting;
}

}  // namespace

ProbeFile parse_probe_file(const std::string& text, const std::string& mapping) {
    for (const std::string known : {"angular", "equirect"})
        if (text.ends_with(":" + known)) return {text.substr(0, text.size() - known.size() - 1), known};
    return {text, mapping};
}

std::size_t vertex_light_bytes(const diffraction::BakedTables& tables) {
    return std::visit(
        []<typename Tables>(const Tables& table) -> std::size_t {
            constexpr bool harmonics = std::is_same_v<Tables, diffraction::SpikeTable> ||
                                       std::is_same_v<Tables, diffraction::BinTable> ||
                                       std::is_same_v<Tables, diffraction::TransferTable>;
            if constexpr (harmonics) return static_cast<std::size_t>(table.bands * table.bands) * 3 * sizeof(float);
            if constexpr (std::is_same_v<Tables, diffraction::ArcTable>)
                return diffraction::weight_layers(table.rank) * 3 * sizeof(glm::vec4);
            return 0;
        },
        tables);
}

Sweep::Sweep(SweepInputs inputs)
    : inputs_(std::move(inputs)),
      picture_(trade::picture_frames(far_camera(), inputs_.picture_size.x, inputs_.picture_size.y)),
      references_(inputs_.folder / "references.jsonl"),
      results_(inputs_.folder / "journal.jsonl") {
    for (const auto& path : inputs_.materials) {
        const nlohmann::json json = parse_json(read_text_file(path, kLargestMaterial), path.string());
        materials_.push_back({json, path.string(), material_hash(json, path), diffraction::load_material(path)});
    }
    for (const ProbeFile& file : inputs_.probes)
        probes_.push_back(
            {read_probe(file.path, file.mapping), hash_of_file(file.path, kLargestProbe, file.mapping), {}});
}

std::vector<const FrameSet*> Sweep::sets() const {
    std::vector<const FrameSet*> result;
    for (const FrameSet& set : inputs_.frame_sets) result.push_back(&set);
    result.push_back(&picture_.frames);
    return result;
}

diffraction::CookedMaterial Sweep::cook(std::size_t material, const Setting& setting) const {
    return trade::cook(materials_[material].json, materials_[material].file, setting);
}

std::vector<glm::dvec3> Sweep::reference(std::size_t material, std::size_t probe, const FrameSet& set) {
    const std::vector<diffraction::Frame> frames = all_frames(set);
    const diffraction::Material& parsed = materials_[material].parsed;
    const colour::LightSpectra spectra(parsed.quality.illuminant);
    std::vector<glm::dvec3> result;
    Progress progress("reference, " + set.name, frames.size());
    for (std::size_t begin = 0; begin < frames.size(); begin += kReferenceChunk) {
        const auto chunk = std::span(frames).subspan(begin, std::min(kReferenceChunk, frames.size() - begin));
        const std::string key =
            key_of({reference_version(), materials_[material].hash, probes_[probe].hash, hash_of(chunk)});
        if (references_.find(key) == nullptr)
            references_.add(key, to_json(reference_radiance(parsed.grating, probes_[probe].image, spectra, chunk)));
        const std::vector<glm::dvec3> part = to_vectors(*references_.find(key));
        result.insert(result.end(), part.begin(), part.end());
        progress.advance(chunk.size());
    }
    return result;
}

const diffraction::EvaluationLight& Sweep::light(std::size_t probe, const Setting& setting) {
    const auto key = std::tuple(probe, setting.key_lights, setting.window);
    const auto found = lights_.find(key);
    if (found != lights_.end()) return found->second;
    ProbeSource& source = probes_[probe];
    if (source.projected.bands == 0) source.projected = lighting::project(source.image, kMostBands);
    return lights_
        .emplace(key, diffraction::EvaluationLight(source.image, setting.key_lights, setting.window, source.projected))
        .first->second;
}

std::vector<glm::dvec3> Sweep::by_setting(std::size_t material, std::size_t probe, const Setting& setting,
                                          const FrameSet& set) {
    return shaded(cook(material, setting), light(probe, setting), set);
}

std::string Sweep::error_key(const Job& job, const Setting& setting, const FrameSet& set) const {
    return key_of({"error", reference_version(), method_version(), trade::to_json(setting).dump(),
                   materials_[job.material].hash, probes_[job.probe].hash, hash_of(all_frames(set))});
}

std::string Sweep::time_key(std::size_t material, const Setting& setting, const std::string& device) const {
    return key_of({"time", method_version(), trade::to_json(without_window(setting)).dump(), materials_[material].hash,
                   probes_.front().hash, device, fmt::format("{}x{}", inputs_.frame_size.x, inputs_.frame_size.y)});
}

void Sweep::measure_errors(const SweepResults& results) {
    std::vector<Job> jobs;
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (std::size_t s = 0; s < results.settings[m].size(); ++s)
            for (std::size_t p = 0; p < probes_.size(); ++p) {
                const Job job{m, s, p};
                for (const FrameSet* set : sets())
                    if (applies(results.settings[m][s], *set) &&
                        results_.find(error_key(job, results.settings[m][s], *set)) == nullptr) {
                        jobs.push_back(job);
                        break;
                    }
            }
    if (jobs.empty()) return;
    log_info("errors of {} settings to measure", jobs.size());
    std::map<std::tuple<std::size_t, std::size_t, std::string>, std::vector<glm::dvec3>> references;
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (std::size_t p = 0; p < probes_.size(); ++p)
            for (const FrameSet* set : sets()) references[{m, p, set->name}] = reference(m, p, *set);

    Progress progress("errors", jobs.size());
    std::optional<diffraction::CookedMaterial> cooked;
    const Job* cooked_for = nullptr;
    for (const Job& job : jobs) {
        const Setting& setting = results.settings[job.material][job.setting];
        if (cooked_for == nullptr || cooked_for->material != job.material || cooked_for->setting != job.setting)
            cooked = cook(job.material, setting);
        cooked_for = &job;
        for (const FrameSet* set : sets()) {
            const std::string key = error_key(job, setting, *set);
            if (!applies(setting, *set) || results_.find(key) != nullptr) continue;
            const auto radiance = shaded(*cooked, light(job.probe, setting), *set);
            nlohmann::json entry = to_json(compare(radiance, references[{job.material, job.probe, set->name}]));
            entry["of"] = {results.materials[job.material], results.probes[job.probe], set->name,
                           setting_name(setting)};
            results_.add(key, std::move(entry));
        }
        progress.advance();
    }
}

void Sweep::measure_times(SweepResults& results) {
    if (!inputs_.times || probes_.empty()) return;
    FrameTimer timer(probes_.front().image, inputs_.frame_size);
    results.device = timer.device();
    std::vector<Job> jobs;
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (std::size_t s = 0; s < results.settings[m].size(); ++s)
            if (results_.find(time_key(m, results.settings[m][s], results.device)) == nullptr)
                jobs.push_back({m, s, 0});
    // So that light is divided anew as seldom as can be.
    std::stable_sort(jobs.begin(), jobs.end(), [&](const Job& a, const Job& b) {
        return results.settings[a.material][a.setting].key_lights < results.settings[b.material][b.setting].key_lights;
    });
    if (!jobs.empty()) log_info("frames of {} settings to time", jobs.size());
    Progress progress("frame times", jobs.size());
    for (const Job& job : jobs) {
        const Setting& setting = results.settings[job.material][job.setting];
        const std::string key = time_key(job.material, setting, results.device);
        if (results_.find(key) == nullptr) {
            const FrameTime time = timer.time(cook(job.material, setting), setting.key_lights);
            results_.add(key, {{"ms", time.ms},
                               {"plain_ms", time.plain_ms},
                               {"of", {results.materials[job.material], setting_name(setting)}}});
        }
        progress.advance();
    }
}

void Sweep::collect(SweepResults& results) {
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (std::size_t s = 0; s < results.settings[m].size(); ++s) {
            const Setting& setting = results.settings[m][s];
            const auto cooked = cook(m, setting);
            CostRow cost{.material = m,
                         .setting = s,
                         .cost = diffraction::shading_cost(cooked.tables),
                         .vertex_bytes = vertex_light_bytes(cooked.tables),
                         .time = std::nullopt};
            if (!results.device.empty()) {
                const nlohmann::json& time = *results_.find(time_key(m, setting, results.device));
                cost.time = FrameTime{.ms = time.at("ms"), .plain_ms = time.at("plain_ms")};
            }
            results.costs.push_back(cost);
            for (std::size_t p = 0; p < probes_.size(); ++p)
                for (const FrameSet* set : sets())
                    if (applies(setting, *set))
                        results.errors.push_back(
                            {m, p, set->name, s, to_error(*results_.find(error_key({m, s, p}, setting, *set)))});
        }
}

SweepResults Sweep::run() {
    SweepResults results;
    results.materials = stems(inputs_.materials);
    std::vector<std::filesystem::path> paths;
    for (const ProbeFile& file : inputs_.probes) paths.push_back(file.path);
    results.probes = stems(paths);
    for (const MaterialSource& material : materials_)
        results.settings.push_back(inputs_.settings.empty() ? sweep_plan(material.parsed.grating.lobe)
                                                            : inputs_.settings);
    measure_times(results);
    measure_errors(results);
    collect(results);
    return results;
}

}  // namespace rowland::trade
