#include "editor/trade/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "editor/trade/sweep_plan.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/core/text.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/rigorous/efficiencies.h"

namespace rowland::trade {

namespace {

constexpr std::uint64_t kLargestProbe = std::uint64_t{1} << 31;
constexpr int kProjectedBands = 16;         ///< the most that a setting takes
constexpr std::size_t kReferencePart = 60;  ///< at most so many points are lost if the program is killed

std::string hash_of_file(const std::filesystem::path& path, std::uint64_t largest, const std::string& with) {
    return Hasher().bytes(read_file(path, largest)).text(with).digest().hex();
}

/// Covers the material without "quality", which the setting replaces, its illuminant, and the files that it names.
std::string material_hash(nlohmann::json json, const std::filesystem::path& path) {
    std::string illuminant;
    if (json.contains("quality")) illuminant = json["quality"].value("illuminant", "");
    json.erase("quality");
    Hasher hasher;
    hasher.text(json.dump()).text(illuminant);
    for (const auto& file : files_named_in(json, path.parent_path()))
        hasher.bytes(read_file(file, diffraction::kMaximumNamedFileSize));
    return hasher.digest().hex();
}

std::string hash_of(std::span<const diffraction::ShadingPoint> frames) {
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

void add_if_known(const char* name, const std::optional<double>& value, nlohmann::json& entry) {
    if (value) entry[name] = *value;
}

std::optional<double> known_in(const nlohmann::json& entry, const char* name) {
    return entry.contains(name) ? std::optional<double>(entry.at(name)) : std::nullopt;
}

/// File names without extension; those that repeat are numbered.
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

/// A planar map is measured on flat surfaces only: on curved ones another representation is drawn instead.
bool applies(const diffraction::Method& setting, const FrameSet& set) {
    return !info(setting).needs_flat_surface ||
           std::ranges::any_of(set.surfaces, [](const auto& surface) { return is_flat(surface); });
}

/// For keys of times: a window does not change the time of a frame.
diffraction::Method without_window(diffraction::Method setting) {
    setting.window = math::SphericalWindow::None;
    return setting;
}

}  // namespace

Sweep::Sweep(SweepInputs inputs)
    : inputs_(std::move(inputs)),
      picture_(trade::picture_frames(far_camera(), inputs_.picture_size.x, inputs_.picture_size.y)),
      references_(inputs_.folder / "references.jsonl"),
      results_(inputs_.folder / "journal.jsonl") {
    for (const auto& path : inputs_.materials) {
        const nlohmann::json json = diffraction::load_material_json(path);
        diffraction::Material parsed = with_efficiencies(diffraction::load_material(path), path.string());
        for (const diffraction::Method& setting : inputs_.settings) check_method(json, path.string(), setting);
        auto settings = inputs_.settings.empty() ? sweep_plan(parsed.grating.lobe) : inputs_.settings;
        if (inputs_.settings.empty())
            std::erase_if(settings, [&](const auto& setting) { return refusal(setting, parsed.grating).has_value(); });
        materials_.push_back({json, path.string(), material_hash(json, path), std::move(parsed), settings});
    }
    for (const ProbeFile& file : inputs_.probes) {
        lighting::ProbeImage image = read_probe(file.path, file.mapping);
        const std::string mapping = lighting::mapping_name(image.mapping());
        probes_.push_back({std::move(image), hash_of_file(file.path, kLargestProbe, mapping)});
    }
    for (ProbeSource& probe : probes_)
        probe.lights = std::make_shared<diffraction::ProbeLights>(probe.image, kProjectedBands);
}

const FrameSet& Sweep::set_named(const std::string& name) const {
    const auto found = std::ranges::find(inputs_.frame_sets, name, &FrameSet::name);
    return found != inputs_.frame_sets.end() ? *found : picture_.frames;
}

std::vector<ErrorRow> Sweep::all_rows() const {
    std::vector<std::string> sets;
    for (const FrameSet& set : inputs_.frame_sets) sets.push_back(set.name);
    sets.push_back(picture_.frames.name);
    std::vector<ErrorRow> rows;
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (std::size_t s = 0; s < materials_[m].settings.size(); ++s)
            for (std::size_t p = 0; p < probes_.size(); ++p)
                for (const std::string& set : sets)
                    if (applies(materials_[m].settings[s], set_named(set)))
                        rows.push_back({.material = m, .probe = p, .set = set, .setting = s});
    return rows;
}

diffraction::CookedMaterial Sweep::cook(std::size_t material, const diffraction::Method& setting) const {
    return diffraction::cook(materials_[material].json, materials_[material].file, setting);
}

std::vector<glm::dvec3> Sweep::reference(std::size_t material, const diffraction::Grating& grating, std::size_t probe,
                                         std::span<const diffraction::ShadingPoint> frames) {
    const auto& [json, file, hash, parsed, settings] = materials_[material];
    const std::string theory = grating.theory == diffraction::Theory::Scalar ? "scalar" : "rigorous";
    const std::string key = key_of({reference_version(), hash, theory, probes_[probe].hash, hash_of(frames)});
    if (references_.find(key) == nullptr)
        references_.add(key, to_json(reference_radiance(grating, probes_[probe].image,
                                                        colour::LightSpectra(parsed.quality.illuminant), frames)));
    return to_vectors(*references_.find(key));
}

const diffraction::MeasuredScene& Sweep::scene_of(std::size_t material, const diffraction::Grating& grating,
                                                  std::size_t probe, const FrameSet& set) {
    const auto by_reference = [this, material, grating, probe](std::span<const diffraction::ShadingPoint> part) {
        return reference(material, grating, probe, part);
    };
    diffraction::MeasuredScene scene{set.name, probes_[probe].lights, set.surfaces, kReferencePart, by_reference};
    auto& known = scenes_.try_emplace({material, grating.theory, probe, set.name}, std::move(scene)).first->second;
    known.prepare();
    return known;
}

const diffraction::MeasuredScene& Sweep::scene(std::size_t material, std::size_t probe, const FrameSet& set) {
    return scene_of(material, materials_[material].parsed.grating, probe, set);
}

std::optional<double> Sweep::theory_error(std::size_t material, std::size_t probe, const FrameSet& set) {
    using diffraction::Theory;
    diffraction::Grating scalar = materials_[material].parsed.grating;
    if (rigorous_refusal(scalar)) return std::nullopt;
    diffraction::Grating rigorous = scalar;
    rigorous.theory = Theory::Rigorous;
    if (scalar.theory == Theory::Scalar)
        rigorous.efficiencies = rigorous_efficiencies(rigorous, materials_[material].file);
    scalar.theory = Theory::Scalar;
    scalar.efficiencies = nullptr;
    const std::vector<glm::dvec3>& truth = scene_of(material, rigorous, probe, set).reference;
    return diffraction::relative_rms(scene_of(material, scalar, probe, set).reference, truth);
}

std::string Sweep::error_key(const ErrorRow& row) const {
    const MaterialSource& material = materials_[row.material];
    return key_of({"error", reference_version(), method_version(),
                   diffraction::to_json(material.settings[row.setting]).dump(), material.hash, probes_[row.probe].hash,
                   hash_of(all_frames(set_named(row.set)))});
}

std::string Sweep::time_key(std::size_t material, const diffraction::Method& setting, const std::string& device) const {
    return key_of({"time", method_version(), diffraction::to_json(without_window(setting)).dump(),
                   materials_[material].hash, probes_.front().hash, device,
                   fmt::format("{}x{}", inputs_.frame_size.x, inputs_.frame_size.y)});
}

void Sweep::measure_errors(const SweepResults& results) {
    std::vector<ErrorRow> rows = all_rows();
    std::erase_if(rows, [&](const ErrorRow& row) { return results_.find(error_key(row)) != nullptr; });
    if (rows.empty()) return;
    log_info("{} errors to measure", rows.size());
    for (const ErrorRow& row : rows) scene(row.material, row.probe, set_named(row.set));  // the references first
    Progress progress("errors", rows.size());
    std::optional<diffraction::CookedMaterial> cooked;
    const ErrorRow* cooked_for = nullptr;
    for (const ErrorRow& row : rows) {
        const diffraction::Method& setting = results.settings[row.material][row.setting];
        if (cooked_for == nullptr || cooked_for->material != row.material || cooked_for->setting != row.setting)
            cooked = cook(row.material, setting);
        cooked_for = &row;
        const diffraction::MeasuredScene& measured = scene(row.material, row.probe, set_named(row.set));
        const std::vector<glm::dvec3> shown = measured.shaded(*cooked, setting.key_lights, setting.window);
        const MethodError error = row.set == picture_.frames.name
                                      ? compare_pictures(picture_, shown, measured.reference)
                                      : compare(shown, measured.reference);
        nlohmann::json entry = {
            {"of", {results.materials[row.material], results.probes[row.probe], row.set, method_name(setting)}}};
        for (const auto& [name, value] : kErrorQuantities) entry[name] = error.*value;
        add_if_known("hdr_flip", error.flip, entry);
        results_.add(error_key(row), std::move(entry));
        progress.advance();
    }
}

void Sweep::measure_times(SweepResults& results) {
    if (!inputs_.times || probes_.empty()) return;
    FrameTimer timer(probes_.front().image, inputs_.frame_size);
    results.device = timer.device();
    struct Job {
        std::size_t material;
        diffraction::Method setting;
    };
    std::vector<Job> jobs;
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (const diffraction::Method& setting : results.settings[m])
            if (results_.find(time_key(m, setting, results.device)) == nullptr) jobs.push_back({m, setting});
    // Fitting key lights is slow: settings with the same number of them are timed together.
    std::ranges::stable_sort(jobs, {}, [](const Job& job) { return job.setting.key_lights; });
    if (!jobs.empty()) log_info("frames of {} settings to time", jobs.size());
    Progress progress("frame times", jobs.size());
    for (const auto& [material, setting] : jobs) {
        const std::string key = time_key(material, setting, results.device);
        if (results_.find(key) == nullptr) {
            const FrameTime time = timer.time(cook(material, setting), setting.key_lights);
            nlohmann::json entry = {{"ms", time.ms},
                                    {"plain_ms", time.plain_ms},
                                    {"of", {results.materials[material], method_name(setting)}}};
            add_if_known("spread", time.spread, entry);
            results_.add(key, std::move(entry));
        }
        progress.advance();
    }
}

void Sweep::collect(SweepResults& results) {
    for (std::size_t m = 0; m < materials_.size(); ++m)
        for (std::size_t s = 0; s < results.settings[m].size(); ++s) {
            const diffraction::Method& setting = results.settings[m][s];
            const auto cooked = cook(m, setting);
            CostRow cost{
                .material = m, .setting = s, .cost = diffraction::shading_cost(cooked.tables), .time = std::nullopt};
            if (!results.device.empty()) {
                const nlohmann::json& time = *results_.find(time_key(m, setting, results.device));
                cost.time =
                    FrameTime{.ms = time.at("ms"), .plain_ms = time.at("plain_ms"), .spread = known_in(time, "spread")};
            }
            results.costs.push_back(cost);
        }
    results.errors = all_rows();
    for (ErrorRow& row : results.errors) {
        const nlohmann::json& entry = *results_.find(error_key(row));
        for (const auto& [name, value] : kErrorQuantities) row.error.*value = entry.at(name);
        row.error.flip = known_in(entry, "hdr_flip");
    }
}

SweepResults Sweep::run() {
    SweepResults results;
    results.materials = stems(inputs_.materials);
    std::vector<std::filesystem::path> paths;
    for (const ProbeFile& file : inputs_.probes) paths.push_back(file.path);
    results.probes = stems(paths);
    for (const MaterialSource& material : materials_) results.settings.push_back(material.settings);
    measure_times(results);
    measure_errors(results);
    collect(results);
    return results;
}

}  // namespace rowland::trade
