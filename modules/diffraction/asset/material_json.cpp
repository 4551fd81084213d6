#include "modules/diffraction/asset/material_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::diffraction {

namespace {

constexpr std::uint64_t kMaximumFileSize = 1 << 20;
constexpr NumberRange kPositive{.minimum = 0.0, .minimum_open = true};
constexpr NumberRange kUnit{.minimum = 0.0, .maximum = 1.0};
constexpr int kHighestOrder = 10000;

Profile parse_profile(JsonReader json, double pitch_nm) {
    const std::string type = json.choice("type", {"slit", "lamellar", "sinusoidal", "blazed"});
    Profile profile;
    if (type == "slit") {
        const NumberRange width{.minimum = 0.0, .maximum = pitch_nm, .minimum_open = true};
        profile = SlitProfile{.width_nm = json.number("width_nm", width)};
    } else if (type == "lamellar") {
        const NumberRange duty{.minimum = 0.0, .maximum = 1.0, .minimum_open = true, .maximum_open = true};
        profile = LamellarProfile{.duty = json.number("duty", duty), .depth_nm = json.number("depth_nm", kPositive)};
    } else if (type == "sinusoidal") {
        profile = SinusoidalProfile{.depth_nm = json.number("depth_nm", kPositive)};
    } else {
        profile = BlazedProfile{.depth_nm = json.number("depth_nm", kPositive)};
    }
    json.finish();
    return profile;
}

std::vector<int> parse_orders(JsonReader& json, double pitch_nm) {
    const nlohmann::json& value = json.raw("orders");
    if (value == "all") return all_orders(pitch_nm);
    if (!value.is_array() || value.empty())
        json.fail("orders", value.is_array() ? "an empty list" : "another type", "a list of whole numbers, or \"all\"");
    std::vector<int> orders;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string place = fmt::format("orders/{}", i);
        if (!value[i].is_number_integer() || std::abs(value[i].get<double>()) > kHighestOrder)
            json.fail(place, value[i].is_number() ? value[i].dump() : "another type",
                      fmt::format("a whole number in [-{0}, {0}]", kHighestOrder));
        const int order = value[i].get<int>();
        if (std::find(orders.begin(), orders.end(), order) != orders.end())
            json.fail(place, fmt::format("order {} twice", order), "each order once");
        orders.push_back(order);
    }
    std::sort(orders.begin(), orders.end());
    return orders;
}

GrooveLobe parse_lobe(JsonReader& json) {
    const nlohmann::json& value = json.raw("groove_lobe");
    if (value == "flat") return FlatLobe{};
    if (!value.is_object()) json.fail("groove_lobe", value.dump(), "\"flat\" or an object such as { \"sigma\": 0.2 }");
    JsonReader lobe = json.object("groove_lobe");
    const GaussianLobe gaussian{.sigma = lobe.number("sigma", kPositive)};
    lobe.finish();
    return gaussian;
}

colour::Metal parse_metal(const std::string& symbol) {
    if (symbol == "Al") return colour::Metal::Al;
    if (symbol == "Ag") return colour::Metal::Ag;
    if (symbol == "Au") return colour::Metal::Au;
    return colour::Metal::Cu;
}

Grating parse_grating(JsonReader json) {
    Grating grating;
    grating.pitch_nm = json.number("pitch_nm", {.minimum = 1.0, .maximum = 1e7});
    grating.profile = parse_profile(json.object("profile"), grating.pitch_nm);
    grating.grooves = json.number_or("grooves", grating.grooves, {.minimum = 1.0, .maximum = 1e9});
    if (json.has("orders")) grating.orders = parse_orders(json, grating.pitch_nm);
    if (json.choice_or("normalization", "energy", {"energy", "agu"}) == "agu") {
        if (!std::holds_alternative<SlitProfile>(grating.profile))
            json.fail("normalization", "\"agu\" with another profile than \"slit\"", "\"energy\"",
                      "the paper's normalisation is defined for its slit only");
        grating.normalization = Normalization::Agu;
    }
    if (json.has("groove_lobe")) grating.lobe = parse_lobe(json);
    json.finish();
    return grating;
}

BaseLayer parse_base(JsonReader json) {
    BaseLayer base;
    if (json.has("color")) {
        const std::vector<double> rgb = json.numbers("color", 3, kUnit);
        base.colour = glm::vec3(rgb[0], rgb[1], rgb[2]);
    }
    base.roughness = static_cast<float>(json.number_or("roughness", static_cast<double>(base.roughness), kUnit));
    json.finish();
    return base;
}

Quality parse_quality(JsonReader json) {
    Quality quality;
    quality.max_error = json.number_or("max_error", quality.max_error, kPositive);
    if (json.has("representation")) {
        json.choice("representation", {"spikes"});
        SpikeTableSettings pinned;
        pinned.spikes.bands = static_cast<int>(json.integer_or("bands", pinned.spikes.bands, 1, 16));
        pinned.spikes.spikes = static_cast<int>(json.integer_or("spikes", pinned.spikes.spikes, 1, 64));
        json.choice_or("view_mapping", "spherical", {"spherical"});
        pinned.theta_nodes = static_cast<int>(json.integer_or("view_resolution", pinned.theta_nodes, 2, 512));
        pinned.phi_nodes = 2 * pinned.theta_nodes;
        const bool half = json.choice_or("storage", "unorm16", {"unorm16", "fp16"}) == "fp16";
        pinned.storage = half ? Storage::Half : Storage::Unorm16;
        quality.pinned = pinned;
    }
    json.finish();
    return quality;
}

}  // namespace

SpikeTableSettings table_settings(const Material& material) {
    return material.quality.pinned.value_or(SpikeTableSettings{});
}

Material parse_material(const nlohmann::json& json, const std::string& file) {
    JsonReader reader(json, file);
    Material material;
    material.grating = parse_grating(reader.object("grating"));
    if (reader.has("metal")) material.grating.metal = parse_metal(reader.choice("metal", {"Al", "Ag", "Au", "Cu"}));
    if (reader.has("base")) material.base = parse_base(reader.object("base"));
    if (reader.has("quality")) material.quality = parse_quality(reader.object("quality"));
    reader.finish();
    return material;
}

Material load_material(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, kMaximumFileSize);
    return parse_material(parse_json(text, path.string()), path.string());
}

}  // namespace rowland::diffraction
