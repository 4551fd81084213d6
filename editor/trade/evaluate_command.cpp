#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/trade/commands.h"
#include "editor/trade/inputs.h"
#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/probe_image.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/point_shader.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/evaluate/drawn_film.h"
#include "modules/thin_film/reference/film_reference.h"

namespace rowland::trade {

namespace {

/// Below this roughness the lobe is narrower than the spacing of the light's samples, and the film shades as a mirror.
constexpr double kSmoothest = 0.08;

constexpr std::string_view kReference = "reference";
constexpr std::string_view kTable = "table";  ///< given the light of the lobe without error
constexpr std::string_view kDrawn = "drawn";
constexpr std::string_view kDrawnRough = "drawn/rough-reflections";

/// XYZ toward v of a surface of normal n; both unit, n·v > 0.
using Radiance = std::function<glm::dvec3(const glm::dvec3& n, const glm::dvec3& v)>;

Radiance as_drawn(const thin_film::FilmMaterial& film, const lighting::ProbeImage& probe,
                  thin_film::Reflections reflections) {
    return [film, reflections, table = thin_film::bake_film(film), environment = lighting::prefilter(probe)](
               const glm::dvec3& n, const glm::dvec3& v) {
        return thin_film::drawn_radiance(table, film.range.thickest_nm, film.range.roughest, environment, n, v,
                                         reflections);
    };
}

/// The sum over microfacets, each with its own light; or, with a table, its M̄ times the light of the lobe.
Radiance as_summed(const thin_film::FilmMaterial& film, const lighting::ProbeImage& probe,
                   std::optional<thin_film::FilmTable> table) {
    const bool smooth = film.range.roughest < kSmoothest;
    return [film, smooth, &probe, table = std::move(table),
            reference = thin_film::RoughReference(film.film, colour::LightSpectra(film.illuminant)),
            light = smooth ? lighting::LightSamples{} : lighting::light_samples(probe)](const glm::dvec3& n,
                                                                                        const glm::dvec3& v) {
        const double n_v = glm::dot(n, v);
        thin_film::RoughReference::Reflected reflected;
        if (smooth) {
            reflected.without_fresnel = probe.radiance(2.0 * n_v * n - v);
            reflected.xyz = reference.at(n_v) * reflected.without_fresnel;
        } else {
            reflected = reference.reflected(light, n, v, film.range.roughest);
        }
        return table ? table->at(n_v, film.range.thickest_nm, film.range.roughest) * reflected.without_fresnel
                     : reflected.xyz;
    };
}

Radiance radiance_by(std::string_view method, const thin_film::FilmMaterial& film, const lighting::ProbeImage& probe) {
    if (method == kReference) return as_summed(film, probe, {});
    if (method == kTable) return as_summed(film, probe, thin_film::bake_film(film));
    return as_drawn(film, probe,
                    method == kDrawn ? thin_film::Reflections::OneLookUp : thin_film::Reflections::FourLookUps);
}

bool is_film(const nlohmann::json& material) {
    return material.is_object() && material.contains("film");
}

std::vector<glm::dvec3> film_radiance(const nlohmann::json& material, const std::string& file,
                                      const std::string& method, const lighting::ProbeImage& probe,
                                      const std::vector<diffraction::ShadingPoint>& points) {
    if (method != kReference && method != kTable && method != kDrawn && method != kDrawnRough)
        refuse_input("--method", {}, method.empty() ? "none" : method,
                     fmt::format("{}, {}, {} or {}: the material is a film", kReference, kTable, kDrawn, kDrawnRough),
                     "see rowland-trade evaluate --help");
    const thin_film::FilmMaterial film = thin_film::parse_film_material(material, file);
    const Radiance radiance = radiance_by(method, film, probe);
    std::vector<glm::dvec3> result;
    for (const diffraction::ShadingPoint& point : points) {
        const glm::dvec3 n = glm::normalize(point.normal);
        const glm::dvec3 v = glm::normalize(point.view);
        result.push_back(glm::dot(n, v) > 0.0 ? radiance(n, v) : glm::dvec3(0.0));
    }
    return result;
}

std::vector<std::string> method_names() {
    std::vector<std::string> names{"reference"};
    for (const diffraction::RepresentationInfo* info : diffraction::representations()) names.emplace_back(info->name);
    return names;
}

[[noreturn]] void refuse_usage(std::string option, std::string found, std::string expected) {
    refuse_input(std::move(option), {}, std::move(found), std::move(expected), "see rowland-trade evaluate --help");
}

/// A flag that is another way to write a setting.
struct SettingFlag {
    const char* flag;
    std::vector<const char*> keys;  ///< the first that the method has
    const char* help;
};

const std::vector<SettingFlag>& setting_flags() {
    static const std::vector<SettingFlag> flags{
        {"--bands", {"bands"}, "Bands of the light and of the material"},
        {"--spikes", {"spikes"}, "Spikes for each view"},
        {"--rank", {"rank"}, "Rank of the arc table"},
        {"--resolution",
         {"map_resolution", "view_resolution"},
         "Cells of a map's side, or rows of a view table (spikes are exact for every view if not given)"},
        {"--storage", {"storage"}, "Components of the tables: fp32, fp16, unorm16 (if not given) or unorm8"},
        {"--key-lights",
         {"key_lights"},
         "Bright parts of the probe that are shaded one by one (0; 16 for the methods direct and streak, and for\n"
         "cooked assets that take key lights)"},
        {"--window", {"window"}, "Window on the light's bands: none, lanczos or hann"}};
    return flags;
}

bool is_within(const diffraction::SettingInfo& setting, const std::string& text) {
    if (!setting.words.empty()) return std::ranges::find(setting.words, text) != setting.words.end();
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    return failure == std::errc() && end == text.data() + text.size() && number >= setting.minimum &&
           number <= setting.maximum;
}

/// Refuses a value that no method takes, also where the method in question ignores the flag.
void check_flag(const SettingFlag& flag, const std::string& value) {
    bool has_setting = false;
    for (const diffraction::RepresentationInfo* info : diffraction::representations())
        for (const char* key : flag.keys)
            if (const diffraction::SettingInfo* setting = info->find(key)) {
                if (is_within(*setting, value)) return;
                has_setting = true;
            }
    if (has_setting) refuse_usage(flag.flag, fmt::format("\"{}\"", value), "a value that some method takes");
}

/// The key that a flag sets for a method; none if the method has no such setting.
const char* key_of(const SettingFlag& flag, const diffraction::RepresentationInfo& info) {
    for (const char* key : flag.keys)
        if (info.find(key) != nullptr || key == std::string_view("key_lights") || key == std::string_view("window"))
            return key;
    return nullptr;
}

/// Nine significant digits each.
std::string format_row(const glm::dvec3& xyz) {
    return fmt::format("{:.9g},{:.9g},{:.9g}", xyz.x, xyz.y, xyz.z);
}

/// `rowland-trade evaluate`: XYZ of a material's diffraction term at given frames, by any method, on standard output.
struct EvaluateCommand {
    std::optional<std::filesystem::path> material;
    std::optional<std::filesystem::path> cooked;
    std::optional<std::filesystem::path> probe;
    std::optional<std::filesystem::path> probe_sh;
    std::optional<std::filesystem::path> illuminant;
    std::filesystem::path frames;
    std::string mapping = "auto";
    std::string method;
    /// Settings of the method, as its text would have them after a slash.
    std::map<std::string, std::string> settings;
    bool error = false;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;

 private:
    void check_usage() const;
    void run_film() const;
    diffraction::Method asked_method() const;
    diffraction::EvaluationLight light(int key_lights, math::SphericalWindow window) const;
    std::vector<diffraction::CheckedRadiance> by_reference(const colour::LightSpectra& spectra,
                                                           const std::vector<diffraction::ShadingPoint>& points) const;
    std::vector<glm::dvec3> by_representation(const colour::Illuminant& illuminant,
                                              const std::vector<diffraction::ShadingPoint>& points) const;
};

CLI::App* EvaluateCommand::declare(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("evaluate", "Evaluate a material's diffraction term under a probe, by a chosen method");
    command->footer(
        "Reads frames vx,vy,vz,nx,ny,nz,gx,gy,gz (world axes: toward the eye, normal, grating vector) and writes a "
        "row\n"
        "X,Y,Z for each: the listed orders only, no base layer, no mirror.\n"
        "--bands 5 is another way to write the setting bands=5, and so on; a method ignores flags that it has no\n"
        "setting for. Settings that are not given are the material's where it pins the same method, else the "
        "defaults.\n"
        "A film's material takes the methods reference; table, which is given the light of the lobe without error; "
        "and\n"
        "drawn and drawn/rough-reflections, as a frame shows it without and with that effect.\n"
        "Example:\n"
        "  rowland-trade evaluate --material cd.json --probe sunset.hdr --method reference --frames frames.csv");
    command->add_option("--material", material, "Material, JSON")->type_name("FILE");
    command->add_option("--cooked", cooked, "Cooked material, in place of --material and --method")->type_name("FILE");
    command->add_option("--probe", probe, "Light probe, Radiance .hdr or OpenEXR")->type_name("FILE");
    add_probe_mapping(*command, mapping);
    command->add_option("--probe-sh", probe_sh, "In place of --probe: CSV l,m,r,g,b, which is the light itself")
        ->type_name("FILE");
    command->add_option("--illuminant", illuminant, "CSV wavelength_nm,relative_power of the light; D65 if not given")
        ->type_name("FILE");
    command
        ->add_option("--method", method,
                     fmt::format("One of: {}; settings may follow, as in arc/bands=5/rank=8/key_lights=16",
                                 fmt::join(method_names(), ", ")))
        ->type_name("METHOD");
    for (const SettingFlag& flag : setting_flags())
        command->add_option(flag.flag, settings[flag.flag], flag.help)->type_name("VALUE");
    command->add_flag("--error", error,
                      "With the reference: a fourth column, how much each row changes at half the steps (relative)");
    command->add_option("--frames", frames, "Frames, CSV")->required()->type_name("FILE");
    return command;
}

void EvaluateCommand::check_usage() const {
    if (material.has_value() == cooked.has_value())
        refuse_usage("--material, --cooked", material ? "both" : "neither", "one of them");
    if (probe.has_value() == probe_sh.has_value())
        refuse_usage("--probe, --probe-sh", probe ? "both" : "neither", "one of them");
    for (const SettingFlag& flag : setting_flags())
        if (const std::string& value = settings.at(flag.flag); !value.empty()) check_flag(flag, value);
    if (cooked) {
        if (error) refuse_usage("--error", "--cooked", "--method reference");
        if (!method.empty()) refuse_usage("--method", method, "no method with --cooked: the asset holds its own");
        return;
    }
    if (method.empty()) refuse_usage("--method", "none", fmt::format("one of {}", fmt::join(method_names(), ", ")));
    if (error && method != "reference") refuse_usage("--error", "--method " + method, "--method reference");
}

diffraction::Method EvaluateCommand::asked_method() const {
    const std::string name = method.substr(0, method.find('/'));
    const auto* info = diffraction::find_representation(name);
    if (info == nullptr)
        refuse_usage("--method", name, fmt::format("a method that exists: {}", fmt::join(method_names(), ", ")));
    std::string text = method;
    for (const SettingFlag& flag : setting_flags()) {
        const char* key = key_of(flag, *info);
        std::string value = settings.at(flag.flag);
        if (value.empty() && flag.flag == std::string_view("--storage") && method == name)
            value = storage_name(diffraction::Storage::Unorm16);
        if (key != nullptr && !value.empty()) text += fmt::format("/{}={}", key, value);
    }
    return diffraction::parse_method(text);
}

diffraction::EvaluationLight EvaluateCommand::light(int key_lights, math::SphericalWindow window) const {
    if (!probe_sh) return diffraction::EvaluationLight(read_probe(*probe, mapping), key_lights, window);
    if (key_lights > 0) refuse_usage("--probe-sh", "light without bright parts", "a probe, to take key lights out of");
    return diffraction::EvaluationLight(read_sh_light(*probe_sh), window);
}

std::vector<diffraction::CheckedRadiance> EvaluateCommand::by_reference(
    const colour::LightSpectra& spectra, const std::vector<diffraction::ShadingPoint>& points) const {
    const diffraction::Grating grating =
        with_efficiencies(diffraction::load_material(*material), material->string()).grating;
    const auto evaluate = [&](const auto& lit) {
        if (error) return checked_reference(grating, lit, spectra, points);
        std::vector<diffraction::CheckedRadiance> rows;
        for (const glm::dvec3& xyz : reference_radiance(grating, lit, spectra, points)) rows.push_back({.xyz = xyz});
        return rows;
    };
    return probe_sh ? evaluate(read_sh_light(*probe_sh)) : evaluate(read_probe(*probe, mapping));
}

std::vector<glm::dvec3> EvaluateCommand::by_representation(const colour::Illuminant& white,
                                                           const std::vector<diffraction::ShadingPoint>& points) const {
    if (cooked) {
        const diffraction::CookedMaterial asset = diffraction::load_cooked_material(*cooked);
        const std::string& count = settings.at("--key-lights");
        const std::string& window = settings.at("--window");
        // Parses the two settings as those of any method.
        const diffraction::Method asked = diffraction::parse_method(
            fmt::format("{}{}{}", info(asset.tables).name, count.empty() ? "" : "/key_lights=" + count,
                        window.empty() ? "" : "/window=" + window));
        if (!count.empty() || probe_sh) return evaluate_baked(asset, light(asked.key_lights, asked.window), points);
        const diffraction::EvaluationLight fitted = light(lighting::LightProbeSettings().key_lights, asked.window);
        return evaluate_baked(asset, fitted.with_first(asset.material.quality.key_lights), points);
    }
    const diffraction::Method asked = asked_method();
    const nlohmann::json json = diffraction::load_material_json(*material);
    diffraction::Material shaded = diffraction::parse_material(with_method(json, asked), material->string());
    diffraction::require_baked_grooves(shaded.grating, material->string());
    shaded = with_efficiencies(std::move(shaded), material->string());
    shaded.quality.illuminant = white;
    const diffraction::EvaluationLight lit = light(asked.key_lights, asked.window);
    const auto* spikes = std::get_if<diffraction::SpikeTableSettings>(&*shaded.quality.pinned);
    const bool has_settings = method != info(asked).name;
    if (spikes == nullptr || has_settings || asked.quality.contains("view_resolution") ||
        asked.quality.contains("view_mapping"))
        return evaluate_baked(bake_material(shaded), lit, points);
    diffraction::CookedMaterial kernel = diffraction::bake_kernel(shaded);
    diffraction::SpikeSettings exact = spikes->spikes;
    exact.illuminant = white;
    std::vector<glm::dvec3> xyz =
        evaluate_points(method, exact_spikes(shaded.grating, exact, lit), kernel, lit, points);
    kernel.reflected = diffraction::bake_reflected_side(shaded);
    add_reflected_side(kernel, lit, points, xyz);
    return xyz;
}

void EvaluateCommand::run_film() const {
    if (!probe) refuse_usage("--probe", "none", "a probe: the material is a film");
    if (cooked || probe_sh || illuminant || error)
        refuse_usage("--cooked, --probe-sh, --illuminant, --error", "one of them", "none: the material is a film");
    const auto rows = film_radiance(diffraction::load_material_json(*material), material->string(), method,
                                    read_probe(*probe, mapping), read_frames(frames));
    std::string text = "X,Y,Z\n";
    for (const glm::dvec3& xyz : rows) text += format_row(xyz) + '\n';
    write_results(text);
}

void EvaluateCommand::run() const {
    if (material && is_film(diffraction::load_material_json(*material))) {
        run_film();
        return;
    }
    check_usage();
    const auto points = read_frames(frames);
    const colour::LightSpectra spectra(illuminant ? colour::load_illuminant(*illuminant) : colour::d65());
    std::string text = error ? "X,Y,Z,error\n" : "X,Y,Z\n";
    if (!cooked && method == "reference") {
        for (const auto& row : by_reference(spectra, points))
            text += format_row(row.xyz) + (error ? fmt::format(",{:.3g}\n", row.error) : "\n");
    } else {
        for (const glm::dvec3& xyz : by_representation(spectra.illuminant(), points)) text += format_row(xyz) + '\n';
    }
    write_results(text);
}

}  // namespace

void add_evaluate_command(CLI::App& program) {
    const auto command = std::make_shared<EvaluateCommand>();
    command->declare(program)->callback([command] { command->run(); });
}

}  // namespace rowland::trade
