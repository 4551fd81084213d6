#include "modules/diffraction/asset/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/rigorous/relief.h"

namespace rowland::diffraction {

namespace {

constexpr std::uint64_t kMaximumFileSize = 1 << 20;

/// Beyond this pitch "all" would be more than a thousand orders of either sign.
constexpr double kLargestPitchOfAll_nm = 190000.0;

/// Longer than any pit; ℓ/λ periods can still be integrated.
constexpr double kLongestPit_nm = 100000.0;

std::vector<int> parse_orders(JsonReader& json, double pitch_nm) {
    const nlohmann::json& value = json.raw("orders");
    if (json.is_recording_schema()) {
        json.annotate("orders", fmt::format(R"({{"oneOf": [{{"const": "all"}}, {{"type": "array", "minItems": 1,
            "uniqueItems": true, "items": {{"type": "integer", "minimum": -{0}, "maximum": {0}}}}}]}})",
                                            kHighestOrder));
        return {1};
    }
    if (value == "all") {
        if (pitch_nm > kLargestPitchOfAll_nm)
            json.fail("orders", fmt::format("\"all\" with a pitch of {} nm", pitch_nm),
                      fmt::format("a pitch of at most {} nm with \"all\"", kLargestPitchOfAll_nm), "list the orders");
        return all_orders(pitch_nm);
    }
    if (!value.is_array() || value.empty())
        json.fail("orders", value.is_array() ? "an empty list" : "another type", "a list of whole numbers, or \"all\"");
    std::vector<int> orders;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string location = fmt::format("orders/{}", i);
        if (!value[i].is_number_integer() || std::abs(value[i].get<double>()) > kHighestOrder)
            json.fail(location, value[i].is_number() ? value[i].dump() : "another type",
                      fmt::format("a whole number in [-{0}, {0}]", kHighestOrder));
        const int order = value[i].get<int>();
        if (std::find(orders.begin(), orders.end(), order) != orders.end())
            json.fail(location, fmt::format("order {} twice", order), "each order once");
        orders.push_back(order);
    }
    std::sort(orders.begin(), orders.end());
    return orders;
}

PitsLobe parse_pits(JsonReader json) {
    const NumberRange length{.minimum = 0.0, .maximum = kLongestPit_nm, .exclusive_minimum = true};
    const PitsLobe pits{.length_nm = json.number("length_nm", length), .coherent = json.number("coherent", kFraction)};
    json.finish();
    return pits;
}

/// σ of a pit sequence's orders. At the least they are as narrow as the fringes of the longest pit, which quadratures
/// resolve; at the largest the track is coherent over less than a wavelength.
constexpr NumberRange kPitOrderSigma{.minimum = 0.004, .maximum = 0.2};
constexpr NumberRange kPitSpacing_nm{.minimum = 100.0, .maximum = kLongestPit_nm};

std::vector<double> parse_pit_spacings(JsonReader& json) {
    const char* const key = "spacings_nm";
    const nlohmann::json& value = json.raw(key);
    if (json.is_recording_schema()) {
        json.annotate(key, fmt::format(R"({{"type": "array", "minItems": 1, "maxItems": {}, "uniqueItems": true,
            "items": {{"type": "number", "minimum": {}, "maximum": {}}}}})",
                                       kMostPitSpacings, kPitSpacing_nm.minimum, kPitSpacing_nm.maximum));
        return {kPitSpacing_nm.minimum};
    }
    if (!value.is_array() || value.empty() || value.size() > kMostPitSpacings)
        json.fail(key, value.is_array() ? fmt::format("a list of {}", value.size()) : "another type",
                  fmt::format("a list of 1 to {} numbers", kMostPitSpacings));
    std::vector<double> spacings_nm;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string location = fmt::format("{}/{}", key, i);
        if (!value[i].is_number()) json.fail(location, "another type", "a number");
        const double spacing_nm = value[i].get<double>();
        if (!(spacing_nm >= kPitSpacing_nm.minimum && spacing_nm <= kPitSpacing_nm.maximum))
            json.fail(location, value[i].dump(),
                      fmt::format("a number in [{}, {}]", kPitSpacing_nm.minimum, kPitSpacing_nm.maximum));
        if (i > 0 && spacing_nm <= spacings_nm.back())
            json.fail(location, fmt::format("{} after {}", spacing_nm, spacings_nm.back()), "ascending spacings");
        spacings_nm.push_back(spacing_nm);
    }
    return spacings_nm;
}

PitSequenceLobe parse_pit_sequence(JsonReader json) {
    const PitSequenceLobe known;
    PitSequenceLobe sequence;
    sequence.spacings_nm = parse_pit_spacings(json);
    sequence.coherent = json.number_or("coherent", known.coherent, kFraction);
    sequence.sigma = json.number_or("sigma", known.sigma, kPitOrderSigma);
    json.finish();
    return sequence;
}

/// Diffraction by a metre of groove widens a lobe by more than this least σ. Far smaller ones are lost in the rounding
/// of s_h + v_h.
constexpr NumberRange kSigma{.minimum = 1e-6};

GrooveLobe parse_lobe(JsonReader& json) {
    if (!json.is_recording_schema()) {
        const nlohmann::json& value = json.raw("groove_lobe");
        if (value == "flat") return FlatLobe{};
        if (!value.is_object())
            json.fail("groove_lobe", value.dump(),
                      "\"flat\", { \"sigma\": 0.2 }, { \"pits\": { \"length_nm\": 850, \"coherent\": 0.3 } } or "
                      "{ \"pit_sequence\": { \"spacings_nm\": [900, 1200] } }");
    }
    GrooveLobe lobe;
    JsonReader reader = json.object("groove_lobe");
    reader.alternatives(
        {{"pits", [&](JsonReader& with) { lobe = parse_pits(with.object("pits")); }},
         {"pit_sequence", [&](JsonReader& with) { lobe = parse_pit_sequence(with.object("pit_sequence")); }}},
        [&](JsonReader& without) { lobe = GaussianLobe{.sigma = without.number("sigma", kSigma)}; });
    reader.finish();
    json.also_allows("groove_lobe", R"({"const": "flat"})");
    return lobe;
}

/// The wide orders of few grooves need the groove's spectrum between the orders, and one lobe for all wavelengths.
void check_few_grooves(JsonReader& json, const Grating& grating) {
    if (grating.grooves >= kManyGrooves || json.is_recording_schema()) return;
    const auto refuse = [&](const char* what, const char* why) {
        json.fail("grooves", fmt::format("{} with {}", grating.grooves, what), fmt::format("at least {}", kManyGrooves),
                  why);
    };
    if (std::holds_alternative<EfficiencyTable>(grating.profile))
        refuse("a table of efficiencies", "a table does not hold the groove's spectrum between the orders");
    if (depends_on_wavelength(grating.lobe))
        refuse("a lobe of pits", "with few grooves the lobe must be the same for every wavelength");
}

std::vector<DielectricFilm> parse_films(JsonReader& json, double pitch_nm) {
    NumberRange thickness = kPositive;
    if (!json.is_recording_schema()) thickness.maximum = pitch_nm;  // thicker ones do not follow the relief
    std::vector<DielectricFilm> films;
    for (JsonReader& film : json.objects("films", 1, kMaximumFilms)) {
        films.push_back({.ior = film.number("ior", {.minimum = 1.0, .maximum = 4.0}),
                         .thickness_nm = film.number("thickness_nm", thickness)});
        film.finish();
    }
    return films;
}

Grating parse_grooves(JsonReader& json, const ReadNamed& read) {
    Grating grating;
    grating.pitch_nm = json.number("pitch_nm", {.minimum = 1.0, .maximum = 1e7});
    grating.profile = parse_profile(json.object("profile"), grating.pitch_nm, read);
    if (json.choice_or("theory", "scalar", {"scalar", "rigorous"}) == "rigorous") grating.theory = Theory::Rigorous;
    if (json.has("films")) grating.films = parse_films(json, grating.pitch_nm);
    if (depends_on_incidence(grating.profile))
        grating.efficiencies = std::make_shared<const EfficiencyGrid>(
            efficiency_grid(std::get<EfficiencyTable>(grating.profile), grating.pitch_nm));
    grating.grooves = json.number_or("grooves", grating.grooves, {.minimum = 1.0, .maximum = 1e9});
    if (json.has("orders")) grating.orders = parse_orders(json, grating.pitch_nm);
    if (json.choice_or("normalization", "energy", {"energy", "agu"}) == "agu") {
        if (!std::holds_alternative<SlitProfile>(grating.profile))
            json.fail("normalization", "\"agu\" with another profile than \"slit\"", "\"energy\"",
                      "the paper's normalisation is defined for its slit only");
        grating.normalization = Normalization::Agu;
    }
    if (json.has("groove_lobe")) grating.lobe = parse_lobe(json);
    check_few_grooves(json, grating);
    return grating;
}

Grating parse_grating(JsonReader json, const ReadNamed& read) {
    Grating grating;
    json.alternatives(
        "lattice", [&](JsonReader& lattice) { grating = parse_lattice_grating(lattice, read); },
        [&](JsonReader& grooves) { grating = parse_grooves(grooves, read); });
    json.finish();
    return grating;
}

/// Chooses rigorous theory where it can solve the grooves, unless the file names a theory, a representation that cannot
/// take it, or a sheet without films. Films need rigorous theory.
void choose_theory(JsonReader& json, Material& material) {
    if (json.is_recording_schema()) return;
    Grating& grating = material.grating;
    const bool named = json.raw("grating").contains("theory");
    const auto refused = rigorous_refusal(grating);
    if (grating.theory == Theory::Rigorous && refused)
        json.fail(refused->key.substr(1), refused->found, refused->expected, refused->remedy);
    const auto& pinned = material.quality.pinned;
    const bool takes_it = !pinned || !std::holds_alternative<StreakSurfaceSettings>(*pinned);
    const bool by_default = !grating.transmission || !grating.films.empty();
    if (!named && !refused && takes_it && by_default) grating.theory = Theory::Rigorous;
    if (!grating.films.empty() && grating.theory == Theory::Scalar)
        json.fail("grating/films", "films without rigorous theory",
                  "lamellar, sinusoidal or blazed grooves of a metal or a sheet", "leave the films out");
}

/// Every transparent solid in visible light; diamond has 2.42.
constexpr NumberRange kIor{.minimum = 1.0, .maximum = 3.0};

Cover parse_cover(JsonReader json, const Profile& profile) {
    Cover cover{.ior = json.number("ior", kIor)};
    if (json.has("tint")) {
        if (std::holds_alternative<EfficiencyTable>(profile))
            json.fail("tint", "a tint beside a table of efficiencies", "no tint",
                      "the table's efficiencies are those under its cover's dye already");
        cover.tint = read_vector<glm::dvec3>(json, "tint", kFraction);
    }
    json.finish();
    return cover;
}

Transmission parse_transmission(JsonReader json, const Profile& profile) {
    const Transmission transmission{.ior = json.number("ior", kIor),
                                    .reflectance = json.number_or("reflectance", 0.0, kFraction)};
    if (transmission.reflectance > 0.0 && std::holds_alternative<EfficiencyTable>(profile))
        json.fail("reflectance", "a reflectance beside a table of efficiencies", "no reflectance",
                  "the table's efficiencies are those of the transmitted orders");
    json.finish();
    return transmission;
}

/// Refuses the members that a sheet that transmits cannot have.
void refuse_beside_transmission(JsonReader& json) {
    json.refuse_if_there("metal", "a metal beside a transmission", "no metal", "a sheet that transmits light has none");
    json.refuse_if_there("cover", "a cover beside a transmission", "no cover",
                         "for grooves in another medium, ior is 1 plus the difference of the two indices");
}

BaseLayer parse_base(JsonReader json) {
    BaseLayer base;
    base.colour = read_vector_or(json, "color", base.colour, kFraction);
    base.roughness = static_cast<float>(json.number_or("roughness", static_cast<double>(base.roughness), kFraction));
    json.finish();
    return base;
}

Representation default_representation(const Grating& grating) {
    if (!grating.lattice) return SpikeTableSettings{};
    const nlohmann::json settings = {{"map_resolution", 128}};  // an eighth of the memory of planar's own default
    JsonReader reader(settings, "defaults");
    return PlanarSettings::from(SettingValues(PlanarSettings::info(), reader), grating);
}

/// Efficiencies of a grating at one wavelength and normal incidence.
struct Efficiencies {
    double zero = 0.0;    ///< η₀
    double listed = 0.0;  ///< Σ listed η without η₀
    double all = 1.0;     ///< of all orders; 1 by scalar theory, whose base layer receives what the metal absorbs
};

Efficiencies efficiencies(const Grating& grating, double wavelength_nm) {
    if (grating.lattice) {
        const std::vector<double> orders = lattice_order_efficiencies(grating, wavelength_nm);
        const double zero = orders[orders.size() / 2];
        return {zero, std::accumulate(orders.begin(), orders.end(), -zero)};
    }
    Efficiencies found{.zero = zero_order_efficiency(grating, wavelength_nm)};
    const bool rigorous = depends_on_direction(grating);
    const auto takes_light = [&](int order) { return !rigorous || std::abs(order * wavelength_nm) < grating.pitch_nm; };
    for (const int order : grating.orders)
        if (order != 0 && takes_light(order)) found.listed += order_efficiency(grating, order, wavelength_nm);
    if (!rigorous) return found;
    found.all = grating.transmission ? grating.transmission->reflectance : 0.0;  // seen on the other side
    for (const int order : grating.efficiencies->orders)
        if (takes_light(order)) found.all += order_efficiency(grating, order, wavelength_nm);
    return found;
}

/// For who makes a user interface of the schema.
void annotate(JsonReader& reader, const ProfileMember& member) {
    if (!reader.is_recording_schema()) return;
    const std::string unit = *member.unit == '\0' ? "" : fmt::format(" ({})", member.unit);
    const std::string initial = member.value == nullptr ? "" : fmt::format(", \"default\": {}", member.initial);
    reader.annotate(member.key, fmt::format(R"({{"title": "{}{}"{}}})", member.label, unit, initial));
}

}  // namespace

Profile parse_profile(JsonReader json, double pitch_nm, const ReadNamed& read) {
    std::vector<const ProfileDescriptor*> offered;
    std::vector<std::string_view> names;
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        if (!read && descriptor.members.front().value == nullptr) continue;
        offered.push_back(&descriptor);
        names.push_back(descriptor.name);
    }
    if (json.is_recording_schema()) pitch_nm = std::numeric_limits<double>::infinity();
    Profile profile;
    json.variant("type", names, [&](JsonReader& reader, std::size_t type) {
        profile = offered[type]->empty;
        for (const ProfileMember& member : offered[type]->members) {
            if (member.value == nullptr) {
                const std::string name = reader.file_name(member.key, "a CSV file of efficiencies");
                annotate(reader, member);
                if (reader.is_recording_schema()) return;
                const NamedText table = read(name);
                profile = parse_efficiency_csv(table.text, table.file);
                return;
            }
            NumberRange range = kPositive;
            range.maximum = member.within_pitch ? pitch_nm : member.less_than;
            range.exclusive_maximum = !member.within_pitch && std::isfinite(member.less_than);
            member.value(profile) = reader.number(member.key, range);
            annotate(reader, member);
        }
    });
    json.finish();
    return json.is_recording_schema() ? SlitProfile{} : profile;
}

Representation representation(const Material& material) {
    Representation result = material.quality.pinned.value_or(default_representation(material.grating));
    set_illuminant(result, material.quality.illuminant);
    // The settings were read before the efficiencies were solved.
    if (auto* planar = std::get_if<PlanarSettings>(&result)) planar->grating = material.grating;
    return result;
}

Material parse_material(JsonReader& reader, const ReadNamed& read) {
    Material material;
    material.grating = parse_grating(reader.object("grating"), read);
    if (reader.has("metal")) {
        if (std::holds_alternative<EfficiencyTable>(material.grating.profile))
            reader.fail("metal", "a metal beside a table of efficiencies", "no metal",
                        "the table's efficiencies are those of its metal already");
        material.grating.metal = colour::read_metal(reader);
    }
    if (reader.has("cover")) material.grating.cover = parse_cover(reader.object("cover"), material.grating.profile);
    if (reader.has("transmission")) {
        refuse_beside_transmission(reader);
        material.grating.transmission = parse_transmission(reader.object("transmission"), material.grating.profile);
    }
    if (reader.has("base")) material.base = parse_base(reader.object("base"));
    if (reader.has("quality")) material.quality = parse_quality(reader.object("quality"), material.grating, read);
    choose_theory(reader, material);
    return material;
}

ReadNamed read_beside(std::filesystem::path folder) {
    return [folder = std::move(folder)](const std::string& name) {
        const std::filesystem::path path = folder / name;
        return NamedText{.text = read_text_file(path, kMaximumNamedFileSize), .file = path.string()};
    };
}

Material parse_material(const nlohmann::json& json, const std::string& file, const ReadNamed& read) {
    JsonReader reader(json, file);
    Material material = parse_material(reader, read);
    reader.finish();
    return material;
}

Material parse_material(const nlohmann::json& json, const std::string& file) {
    return parse_material(json, file, read_beside(std::filesystem::path(file).parent_path()));
}

nlohmann::json load_material_json(const std::filesystem::path& path) {
    return parse_json(read_text_file(path, kMaximumFileSize), path.string());
}

Material load_material(const std::filesystem::path& path) {
    return parse_material(load_material_json(path), path.string());
}

LayerWeights layer_weights(const Grating& grating, const colour::Illuminant& illuminant) {
    const std::optional<Grating> other_side = reflected_side(grating);
    const colour::LightSpectra spectra(illuminant);
    const bool lists_zero = std::find(grating.orders.begin(), grating.orders.end(), 0) != grating.orders.end();
    LayerWeights weights{.mirror = glm::dvec3(0.0), .base = glm::dvec3(0.0), .reflected = glm::dvec3(0.0)};
    for (int wavelength_nm = colour::kVisibleMin; wavelength_nm <= colour::kVisibleMax; ++wavelength_nm) {
        const bool end = wavelength_nm == colour::kVisibleMin || wavelength_nm == colour::kVisibleMax;
        const glm::dvec3 e = spectra(wavelength_nm);
        const glm::dvec3 white = (end ? 0.5 : 1.0) * (e.r + e.g + e.b) * colour::cie_xyz(wavelength_nm);
        const Efficiencies of_grating = efficiencies(grating, wavelength_nm);
        const Efficiencies of_other = other_side ? efficiencies(*other_side, wavelength_nm) : Efficiencies{};
        const double taken = of_grating.zero + of_grating.listed + (of_other.zero + of_other.listed);
        if (!grating.transmission) weights.reflected += (of_grating.zero + of_grating.listed) * white;
        if (!lists_zero) weights.mirror += of_grating.zero * white;
        if (!grating.side_reflectance) weights.base += std::max(0.0, of_grating.all - taken) * white;
    }
    return weights;
}

}  // namespace rowland::diffraction
