// A schema is recorded from its parser, so it says what the parser does: thousands of small changes to good documents,
// each judged by both.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_schema.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/asset_types.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/foil/recipe.h"
#include "modules/diffraction/model/profile.h"
#include "modules/thin_film/asset/film_material.h"
#include "tests/support/files.h"
#include "tests/support/json_schema.h"

namespace rowland {
namespace {

using nlohmann::json;
using Documents = std::vector<json>;

json read_source(const std::string& path) {
    return parse_json(read_text_file(test::source_path(path), 1 << 20), path);
}

/// What `rowland-cook schema` prints.
json schema_of(const std::string& name) {
    const auto registry = modules::asset_types();
    for (const cook::GltfExtension& extension : registry->gltf_extensions())
        if (extension.name == name) return extension.schema();
    return registry->find(name)->schema();
}

/// Every document that differs from `document` in one member, which is removed, added or replaced.
Documents neighbours(const json& document) {
    static const Documents replacements = {nullptr, true, "", "x", "flat", "all", json::array(), json::object(), -1,
                                           0,       1,    2,  3.5, 64,     1e4,   1e12,          -1e12};
    Documents result;
    const json leaves = document.flatten();
    for (const auto& [pointer, value] : leaves.items()) {
        for (json::json_pointer location(pointer); !location.empty(); location = location.parent_pointer()) {
            const auto with = [&](const std::function<void(json&)>& change) {
                json copy = document;
                change(copy);
                result.push_back(std::move(copy));
            };
            for (const json& replacement : replacements) with([&](json& copy) { copy[location] = replacement; });
            if (document[location.parent_pointer()].is_object()) {
                with([&](json& copy) { copy[location.parent_pointer()].erase(location.back()); });
                with([&](json& copy) { copy[location.parent_pointer()]["unknown"] = 1; });
            }
        }
    }
    return result;
}

/// Expects that a schema allows what the parser takes. `beyond`: what a schema cannot say, because it compares two
/// members; the parser alone refuses it.
void expect_agreement(const json& schema, const Documents& documents, const std::function<void(const json&)>& parse,
                      const std::function<bool(const json&)>& beyond) {
    std::size_t accepted = 0;
    std::size_t refused = 0;
    for (const json& document : documents) {
        ASSERT_TRUE(test::satisfies(document, schema)) << document;
        ASSERT_NO_THROW(parse(document)) << document;
        for (const json& changed : neighbours(document)) {
            bool parsed = true;
            try {
                parse(changed);
            } catch (const Error&) {
                parsed = false;
            }
            const bool allowed = test::satisfies(changed, schema);
            const bool excused = allowed && !parsed && beyond(changed);
            EXPECT_TRUE(parsed == allowed || excused) << (parsed ? "only parsed: " : "only allowed: ") << changed;
            (parsed ? accepted : refused) += 1;
        }
    }
    EXPECT_GT(accepted, 20U);
    EXPECT_GT(refused, 100U);
}

TEST(Schema, IsWhatAParserAsks) {
    const auto parse = [](JsonReader& reader) {
        reader.alternatives(
            "lamp",
            [](JsonReader& lamp) {
                lamp.choice("lamp", {"A", "B"});
            },
            [](JsonReader& mirror) { mirror.number("angle", kFraction); });
        reader.variant("type", {"one", "many"}, [](JsonReader& member, std::size_t type) {
            for (JsonReader& part : member.objects("parts", 1, type == 0 ? 1 : 9)) {
                part.number_or("size", 1.0, kPositive);
                part.finish();
            }
        });
        reader.ignore("extras");
        reader.finish();
    };
    const json schema = json_schema("Test", parse);
    const auto allowed = [&](const char* text) { return test::satisfies(json::parse(text), schema); };
    EXPECT_TRUE(allowed(R"({"lamp": "A", "type": "one", "parts": [{}], "extras": 3})"));
    EXPECT_TRUE(allowed(R"({"angle": 0.5, "type": "many", "parts": [{"size": 2}, {}]})"));
    for (const char* text : {R"({"lamp": "C", "type": "one", "parts": [{}]})", R"({"type": "one", "parts": [{}]})",
                             R"({"angle": 1.5, "type": "one", "parts": [{}]})",
                             R"({"lamp": "A", "angle": 0.5, "type": "one", "parts": [{}]})",
                             R"({"angle": 1, "type": "one", "parts": [{}, {}]})",
                             R"({"angle": 1, "type": "many", "parts": [{"size": [1]}]})",
                             R"({"angle": 1, "type": "many", "parts": [], "more": 1})"})
        EXPECT_FALSE(allowed(text)) << text;
}

/// Blender's add-on makes its fields of them.
TEST(Schema, HasTitlesAndDefaultsOfTheMembersOfProfiles) {
    const json whole = schema_of("material");
    std::map<std::string, json> profiles;
    for (const json& grating : whole["properties"]["grating"]["oneOf"])
        for (const json& profile : grating["properties"]["profile"]["oneOf"])
            profiles[profile["properties"]["type"]["const"]] = profile["properties"];
    for (const diffraction::ProfileDescriptor& descriptor : diffraction::profile_descriptors())
        for (const diffraction::ProfileMember& member : descriptor.members) {
            const json& schema = profiles[std::string(descriptor.name)][member.key];
            const std::string unit = std::string_view(member.unit).empty() ? "" : " (" + std::string(member.unit) + ")";
            EXPECT_EQ(schema.value("title", ""), member.label + unit) << descriptor.name;
            EXPECT_EQ(schema.value("default", 0.0), member.initial) << descriptor.name << " " << member.key;
            EXPECT_EQ(schema.contains("default"), member.value != nullptr) << descriptor.name << " " << member.key;
            EXPECT_TRUE(schema.contains("type")) << "its limits stay";
        }
}

/// Whatever a material calls its table; its lamp is lamp.csv.
diffraction::NamedText read_one_table(const std::string& name) {
    if (name == "lamp.csv") return {.text = "wavelength_nm,relative_power\n500,1\n600,2\n", .file = name};
    if (name == "cell.png") {
        diffraction::HeightMap map{.columns = 16, .rows = 16, .heights = {}, .depth_nm = 0.0};
        map.heights.assign(256, 9);
        return {.text = diffraction::write_height_map(map), .file = name};
    }
    return {.text = "wavelength_nm,R-1,R+1\n500,0.1,0.4\n", .file = name};
}

/// What a representation cannot do with a grating's lobe, or with others of its own settings.
bool crosses_quality(const json& document) {
    const json quality = document.value("quality", json::object());
    const bool flat = document["grating"].value("groove_lobe", json("flat")) == "flat";
    const std::string name = quality.value("representation", "spikes");
    const std::string default_mapping = name == "arc" ? "one-dimensional" : "";
    const bool along_one_axis = quality.value("view_mapping", default_mapping) == "one-dimensional";
    const bool view = flat ? name == "arc" && !along_one_axis : quality.contains("view_mapping") && along_one_axis;
    const bool map = flat ? quality.contains("views_h")
                          : name == "circle" || (name == "planar" && quality.value("map_resolution", 128) > 256);
    const bool narrow = !flat && !document["grating"]["groove_lobe"].contains("pit_sequence") &&
                        document["grating"]["groove_lobe"].value("/pits/coherent"_json_pointer, 1.0) > 0.0;
    const bool streak = name == "streak" && !narrow;
    const int bands = quality.value("bands", 5);
    const bool layers = quality.value("spikes", 1) * (bands * bands + 4) / 4 > 2048;
    return view || map || layers || streak;
}

/// What a cell's sides forbid each other, its profile and its orders.
bool crosses_cell(const json& grating) {
    if (!grating.contains("lattice")) return false;
    const auto a = grating["lattice"]["a_nm"].get<std::vector<double>>();
    const auto b = grating["lattice"]["b_nm"].get<std::vector<double>>();
    const double length_a = std::hypot(a[0], a[1]);
    const double length_b = std::hypot(b[0], b[1]);
    const json& profile = grating["profile"];
    const bool short_or_long = std::min(length_a, length_b) < 300.0 || std::max(length_a, length_b) > 1e7;
    const bool flat = std::abs(a[0] * b[1] - a[1] * b[0]) < 0.0348995 * length_a * length_b;  // 2 degrees
    const bool wide =
        profile["type"] == "aperture" && (profile["width_nm"] > length_a || profile["height_nm"] > length_b);
    const bool picture =
        profile["type"] == "height_map" && (profile["file"] != "cell.png" || 2 * grating.value("orders", 2) >= 16);
    return short_or_long || flat || wide || picture;
}

/// What a material's members forbid each other.
bool crosses_members(const json& document) {
    const json& grating = document["grating"];
    if (crosses_cell(grating)) return true;
    const json& profile = grating["profile"];
    const json lobe = grating.value("groove_lobe", json("flat"));
    const bool wide = profile["type"] == "slit" && profile["width_nm"] > grating["pitch_nm"];
    const bool agu = grating.value("normalization", "energy") == "agu" && profile["type"] != "slit";
    const bool plated_table =
        profile["type"] == "table" && (document.contains("metal") || document.contains("/cover/tint"_json_pointer));
    const bool plated_sheet =
        document.contains("transmission") &&
        (document.contains("metal") || document.contains("cover") ||
         (profile["type"] == "table" && document["transmission"].value("reflectance", 0.0) > 0.0));
    const bool few = grating.value("grooves", 1500.0) < 50.0 &&
                     (profile["type"] == "table" || lobe.contains("pits") || lobe.contains("pit_sequence"));
    const json spacings = lobe.is_object() ? lobe.value("/pit_sequence/spacings_nm"_json_pointer, json()) : json();
    const bool descending = !std::is_sorted(spacings.begin(), spacings.end());
    const bool endless = grating.value("orders", json()) == "all" && grating["pitch_nm"] > 190000.0;
    const std::string lamp = document.value("quality", json::object()).value("illuminant", "D65");
    const auto names = colour::illuminant_names();
    const bool dark = lamp != "lamp.csv" && std::find(names.begin(), names.end(), lamp) == names.end();
    return wide || agu || plated_table || plated_sheet || few || descending || endless || dark ||
           crosses_quality(document);
}

/// A schema cannot know which files there are.
bool names_another_file(const json& document) {
    const json& profile = document["grating"]["profile"];
    return profile["type"] == "table" && profile["file"] != "t.csv";
}

/// What a foil's members forbid each other.
bool crosses_foil(const json& document) {
    const json foil = document.value("foil", json::object());
    const json card = document.value("card", json::object());
    const std::string type = foil.value("type", "");
    const bool freely = foil.contains("spread_deg") && (type == "pillars" || type == "lens" || type == "two_pictures");
    const double width = card.value("width_mm", 63.0);
    const double height = card.value("height_mm", 88.0);
    const double shorter = std::min(width, height);
    return freely || type == "two_pictures" || 2.0 * card.value("corner_mm", 3.0) > shorter ||
           std::max(width, height) > 20.0 * shorter;
}

TEST(Schema, OfFoilsAgreesWithTheParser) {
    const auto card = [](const std::string& foil) {
        return json::parse(R"({"artwork": "a.png", "foil": )" + foil + "}");
    };
    const Documents documents = {
        json::parse(R"({"artwork": "a.png", "mask": "m.png", "ink": "covers", "under": "metal", "texture_px": 600,
                        "lacquer": {"gloss": true, "tint": [1, 0.5, 0]},
                        "card": {"width_mm": 60, "height_mm": 80, "thickness_mm": 0.3, "corner_mm": 2, "back": "b"}})"),
        card(
            R"({"type": "pillars", "band_mm": 8, "pitch_range": 1.5, "direction_deg": 3, "scale": 1, "groove_um": 1})"),
        card(R"({"type": "tiles", "size_mm": 8, "directions": 5, "spread_deg": 3, "seed": 7})"),
        card(R"({"type": "radial", "grooves": "rays", "centre": [0.5, 1]})"),
        card(R"({"type": "two_pictures", "picture_a": "a", "picture_b": "b", "tilts_deg": [-10, 10], "lamp_deg": 40})"),
        card(R"({"type": "lens", "focal_mm": 50})"),
        card(R"({"type": "own", "drawing": "d.png", "smooth_mm": 1})"),
    };
    expect_agreement(
        schema_of("foil"), documents,
        [](const json& document) { diffraction::foil::parse_foil_recipe(document, "card.json"); }, crosses_foil);
}

TEST(Schema, OfMaterialsAgreesWithTheParser) {
    const auto material = [](const std::string& profile, const std::string& rest) {
        return json::parse(R"({"grating": {"pitch_nm": 1600, "grooves": 900, "orders": [-1, 2], "profile": )" +
                           profile + rest);
    };
    const auto pinned = [&](const std::string& quality) {
        return material(R"({"type": "slit", "width_nm": 800}}, "quality": )", quality + "}");
    };
    const auto cell = [](const std::string& profile, const std::string& rest) {
        return json::parse(R"({"grating": {"lattice": {"a_nm": [900, 10], "b_nm": [-100, 2000]}, "profile": )" +
                           profile + rest);
    };
    const Documents documents = {
        cell(R"({"type": "aperture", "width_nm": 500, "height_nm": 600})", R"(, "orders": 3}})"),
        cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 100})", R"(}, "cover": {"ior": 1.5}})"),
        cell(
            R"({"type": "crossed", "along_a": {"type": "lamellar", "duty": 0.4, "depth_nm": 100}, "along_b": {"type": "sinusoidal", "depth_nm": 90}})",
            R"(}, "metal": "Al", "quality": {"representation": "planar"}})"),
        read_source("content/materials/cd.json"),
        read_source("content/materials/cd_paper.json"),
        material(R"({"type": "lamellar", "duty": 0.4, "depth_nm": 100})", R"(, "groove_lobe": {"sigma": 0.2}}})"),
        material(R"({"type": "blazed", "depth_nm": 100}})",
                 R"(, "metal": "Au", "quality": {"max_error": 0.1, "illuminant": "F11"}})"),
        pinned(
            R"({"max_error": 0.1, "measure": "hdr_flip", "surface": "curved", "probes": ["a.json", {"image": "b.hdr", "mapping": "angular"}]})"),
        material(R"({"type": "slit", "width_nm": 0.5}, "normalization": "agu", "orders": "all"}})", ""),
        material(R"({"type": "blazed", "depth_nm": 100}})", R"(, "cover": {"ior": 1.5, "tint": [0.25, 1, 0]}})"),
        material(R"({"type": "lamellar", "duty": 0.5, "depth_nm": 500}})",
                 R"(, "transmission": {"ior": 1.5, "reflectance": 0.25}})"),
        material(R"({"type": "table", "file": "t.csv"}})", R"(, "base": {"roughness": 0.1}})"),
        material(R"({"type": "sinusoidal", "depth_nm": 90})",
                 R"(, "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}}}})"),
        material(
            R"({"type": "sinusoidal", "depth_nm": 90})",
            R"(, "groove_lobe": {"pit_sequence": {"spacings_nm": [900, 1200, 3300], "coherent": 0.3, "sigma": 0.02}}}})"),
        pinned(R"({"representation": "spikes", "spikes": 8, "view_mapping": "parabolic", "key_lights": 64})"),
        pinned(
            R"({"representation": "arc", "bands": 6, "rank": 12, "storage": "fp32", "key_lights": 0, "illuminant": "A", "max_error": 0.2})"),
        pinned(R"({"representation": "direct", "key_lights": 64, "illuminant": "lamp.csv"})"),
        pinned(R"({"representation": "planar", "rank": 6, "map_resolution": 128})"),
        pinned(R"({"representation": "circle", "map_resolution": 32})"),
        material(R"({"type": "slit", "width_nm": 700}, "groove_lobe": {"sigma": 0.1}})",
                 R"(, "quality": {"representation": "streak", "map_resolution": 160, "bands": 4, "rank": 6}})")};
    expect_agreement(
        schema_of("material"), documents,
        [](const json& document) { diffraction::parse_material(document, "test", read_one_table); }, crosses_members);
}

TEST(Schema, OfTheGltfExtensionAgreesWithTheParser) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "t.csv", read_one_table("t.csv").text);
    const Documents documents = {
        json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 600}},
                        "grooveRotation": 1.5, "grooveTexture": {"index": 2, "texCoord": 1}, "metal": "Cu",
                        "cover": {"ior": 1.49}})"),
        json::parse(R"({"grating": {"pitch_nm": 740, "profile": {"type": "table", "file": "t.csv"}},
                        "grooveTexture": {"index": 0, "sparkle": true, "extras": {}}, "extras": [1], "extensions": {"X": 1}})")};
    expect_agreement(
        schema_of(diffraction::kGltfExtension), documents,
        [&](const json& document) { diffraction::parse_gltf_extension(document, "test", folder.path()); },
        [](const json& document) { return crosses_members(document) || names_another_file(document); });
}

TEST(Schema, OfTheEnginesExtensionsAgreeWithTheParser) {
    // A material or a node, its extension set to the document.
    const auto parse = [](const char* array, const std::string& name) {
        return [=](const json& document) {
            json root = {{"asset", {{"version", "2.0"}}}, {"textures", {json::object(), json::object()}}};
            root[array] = {{{"extensions", {{name, document}}}}};
            scene::MemoryBudget budget("test");
            std::vector<std::string> warnings;
            scene::check_gltf(root, "test", {}, budget, warnings);
        };
    };
    const auto missing_texture = [](const json& document) {
        return document.contains("maskTexture") && document["maskTexture"]["index"] > 1;
    };
    const Documents boxes = {json::parse(R"({"size_m": [4, 3, 0.5], "probe": "hall.probe"})"),
                             json::parse(R"({"size_m": [1, 1, 1], "fade_m": 0.25, "probe": "a.probe", "extras": 1})")};
    const Documents marks = {json::parse(R"({"scratches": 0.5, "dust": 1, "seed": 3, "extensions": {}})"),
                             json::parse(R"({"fingerprints": 0.2, "size_m": 0.3, "texCoord": 1,
                                             "maskTexture": {"index": 1, "texCoord": 1}})")};
    auto schemas = scene::own_extension_schemas();
    expect_agreement(schemas.at(scene::kProbeExtension)(), boxes, parse("nodes", scene::kProbeExtension),
                     [](const json&) { return false; });
    expect_agreement(schemas.at(scene::kWearExtension)(), marks, parse("materials", scene::kWearExtension),
                     missing_texture);
}

TEST(Schema, OfFilmsAgreesWithTheParser) {
    const Documents documents = {
        json::parse(R"({"film": {"ior": 1.33, "k": 0.1, "thickness_nm": 400}, "base": {"ior": 1.5, "k": 2},
                        "roughness": 0.3, "illuminant": "F11"})"),
        json::parse(
            R"({"film": [{"ior": 1.4, "thickness_nm": 90}, {"ior": 2.3, "thickness_nm": 60}], "metal": "Au"})")};
    expect_agreement(
        schema_of("film"), documents, [](const json& document) { thin_film::parse_film_material(document, "test"); },
        [](const json&) { return false; });
}

TEST(Schema, GratingsOfTheShippedSceneAreOnesTheModuleReads) {
    const std::vector<std::string> handled = {diffraction::kGltfExtension};
    const scene::ImportedScene cabinet = scene::load_gltf(test::source_path("content/scenes/cabinet.glb"), handled);
    std::vector<double> pitches;
    bool varies = false;
    for (const scene::MaterialDescription& material : cabinet.materials) {
        const auto extension = material.extensions.find(diffraction::kGltfExtension);
        if (extension == material.extensions.end()) continue;
        const diffraction::GltfGrating grating =
            diffraction::parse_gltf_extension(extension->second, "cabinet.glb", ".", "/" + material.name);
        pitches.push_back(grating.material.grating.pitch_nm);
        if (!grating.groove_texture) continue;
        varies = true;
        EXPECT_LT(static_cast<std::size_t>(grating.groove_texture->index), cabinet.textures.size());
    }
    EXPECT_EQ(pitches.size(), 7U);
    EXPECT_TRUE(varies);
}

TEST(Schema, OfProbeRecipesAgreesWithTheParser) {
    const Documents documents = {
        read_source("content/probes/studio.json"),
        read_source("content/probes/clear_sky.json"),
        read_source("content/probes/night.json"),
        json::parse(
            R"({"probe": {"type": "image", "file": "a.hdr", "mapping": "angular", "bands": 8, "key_lights": 9, "face_size": 64}})"),
        json::parse(R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 3, "sun_elevation_deg": 4, "width": 256}})"),
        json::parse(R"({"probe": {"type": "image", "file": "a.hdr", "illuminant": "F11"}})"),
        json::parse(R"({"probe": {"type": "image", "file": "a.hdr", "illuminant": "lamps/sodium.csv"}})")};
    // Names that end in .csv are files; the others must be built in.
    const auto unknown_illuminant = [](const json& document) {
        const json& name = document["probe"].value("illuminant", json("D65"));
        return name.is_string() && !name.get<std::string>().ends_with(".csv");
    };
    expect_agreement(
        schema_of("probe"), documents, [](const json& document) { lighting::parse_probe_recipe(document, "test"); },
        unknown_illuminant);
}

TEST(Schema, OfMeshRecipesAgreesWithTheParser) {
    const Documents documents = {read_source("content/meshes/cd.json"), read_source("content/meshes/sphere.json"),
                                 read_source("content/meshes/ground.json")};
    expect_agreement(
        schema_of("mesh"), documents, [](const json& document) { scene::parse_mesh_recipe(document, "test"); },
        [](const json& document) {
            const json& shape = document["mesh"];
            return shape["type"] == "disc" && shape["outer_radius"] <= shape["inner_radius"];
        });
}

}  // namespace
}  // namespace rowland
