#include "tests/fuzz/seeds.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "engine/asset/container.h"
#include "engine/core/file.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/draco_encode.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "tests/support/test_data.h"

namespace rowland::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestSeed = 3 << 20;

std::vector<fs::path> folders() {
    std::vector<fs::path> result{fs::path(ROWLAND_CONTENT_FOLDER)};
    for (const char* name : {"gltf", "probes", "data"})
        if (const auto found = test::find_data(name)) result.push_back(*found);
    return result;
}

bool is_of(const Format& format, const fs::path& path) {
    const std::string extension = path.extension().string();
    return std::any_of(format.extensions.begin(), format.extensions.end(),
                       [&](const char* known) { return extension == known; });
}

std::vector<std::byte> cooked_material(const char* quality) {
    const nlohmann::json json = {{"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}},
                                 {"quality", nlohmann::json::parse(quality)}};
    return diffraction::write_cooked_material(json, diffraction::cook_material(json, "seed.json"));
}

std::vector<std::byte> packed(std::vector<std::byte> payload) {
    asset::CookedAsset cooked;
    cooked.header.type = diffraction::kMaterialAssetType;
    cooked.header.type_version = diffraction::kMaterialAssetVersion;
    cooked.payload = std::move(payload);
    return asset::pack(cooked);
}

std::vector<std::byte> cooked_probe() {
    const auto json = nlohmann::json::parse(
        R"({"probe": {"type": "clear_sky", "sun_elevation_deg": 40, "sun_azimuth_deg": 0, "width": 64}})");
    const lighting::ProbeRecipe recipe = lighting::parse_probe_recipe(json, "seed.json");
    return lighting::serialise(
        lighting::build_light_probe(lighting::render_recipe(recipe, {}, "seed.json"), recipe.settings));
}

std::vector<Seed> draco_seeds() {
    std::vector<Seed> result;
    for (const int rings : {1, 8}) {
        const scene::Mesh mesh = scene::build_mesh(
            scene::DiscRecipe{.inner_radius = 0.02, .outer_radius = 0.06, .rings = rings, .segments = 12});
        const std::vector<char> stream = scene::encode_draco(mesh).bytes;
        const auto* begin = reinterpret_cast<const std::byte*>(stream.data());
        result.push_back({"disc of " + std::to_string(rings) + " rings", {begin, begin + stream.size()}});
    }
    return result;
}

std::vector<Seed> cooked_seeds() {
    std::vector<Seed> result;
    for (const char* quality :
         {R"({"representation": "spikes", "bands": 2, "view_resolution": 4})",
          R"({"representation": "arc", "rank": 2})", R"({"representation": "planar", "map_resolution": 16})",
          R"({"representation": "circle", "map_resolution": 8})", R"({"representation": "direct"})"})
        result.push_back({quality, cooked_material(quality)});
    return result;
}

}  // namespace

std::vector<Seed> seeds(const Format& format) {
    const std::string_view name = format.name;
    if (name == "draco") return draco_seeds();
    if (name == "cooked-material") return cooked_seeds();
    if (name == "cooked-probe") return {{"clear sky", cooked_probe()}};
    std::vector<Seed> result;
    if (name == "cooked")
        for (Seed& seed : cooked_seeds()) result.push_back({seed.name, packed(std::move(seed.bytes))});
    for (const fs::path& folder : folders())
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && is_of(format, entry.path()) && entry.file_size() <= kLargestSeed)
                result.push_back({entry.path().string(), read_file(entry.path(), kLargestSeed)});
    std::sort(result.begin(), result.end(), [](const Seed& a, const Seed& b) { return a.name < b.name; });
    return result;
}

}  // namespace rowland::fuzz
