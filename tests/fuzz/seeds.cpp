#include "tests/fuzz/seeds.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "content/demo/play/recording.h"
#include "editor/cooker/jobs.h"
#include "engine/asset/container.h"
#include "engine/core/file.h"
#include "engine/image/exr.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/glb_write.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/thin_film/asset/film_material.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestSeed = 2 << 20;

std::vector<fs::path> folders() {
    std::vector<fs::path> result{test::source_path("content")};
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

/// A play with every kind of event.
Seed recording() {
    const test::TemporaryFolder folder;
    const fs::path path = folder.path() / "play.jsonl";
    demo::Recorder recorder(path, {.scene = "cabinet.glb", .window = {640, 360}});
    const std::vector<demo::PlayEvent> events{
        platform::InputEvent(platform::KeyEvent{platform::Key::Space, true}),
        platform::InputEvent(platform::MouseButtonEvent{platform::MouseButton::Left, true}),
        platform::InputEvent(platform::MouseMoveEvent{{12.5, 100.25}}),
        platform::InputEvent(platform::ScrollEvent{{0, -1}}),
        platform::InputEvent(platform::FocusEvent{true}),
        platform::InputEvent(platform::CursorCaptureEvent{false}),
        platform::InputEvent(platform::GamepadEvent{.connected = true, .axes = {}, .buttons = {}}),
        demo::ResizeEvent{{800, 600}},
        demo::ActionEvent{demo::Action::AutoExposure},
        demo::SettingEvent{demo::Setting::Bloom, 0.25},
        demo::SettingEvent{demo::Setting::RightLook, "arc, fine", "disc"},
    };
    recorder.add(3, events);
    recorder.add(7, events);
    recorder.finish(12);
    return {"a play", read_file(path, kLargestSeed)};
}

Seed plan() {
    const std::vector<editor::Job> jobs = {{"0123456789ab", "material", "content/cd.json", "cooked/cd.material"},
                                           {"ba9876543210", "probe", "a \"b\".json", "cooked/\xc3\xa4.probe"}};
    const std::string text = editor::write_plan(jobs);
    return {"two jobs", test::bytes_of(text)};
}

/// Small pictures: captured ones are so large that few mutations of them are tried, and fewer hit what steers.
Seed small_exr() {
    const test::TemporaryFolder folder;
    const fs::path path = folder.path() / "small.exr";
    image::Image picture{.width = 8, .height = 4, .texels = {}};
    for (int i = 0; i < 32; ++i) picture.texels.emplace_back(0.1F * static_cast<float>(i), 1.0F, 1e-3F);
    image::write_exr(path, picture);
    return {"small picture", read_file(path, kLargestSeed)};
}

/// Two scanlines run by run: of each component, eight times 2^0 of mantissa 128.
Seed small_hdr() {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 2 +X 8\n";
    for (int row = 0; row < 2; ++row) {
        text += std::string("\x02\x02\x00\x08", 4);
        for (const char component : {'\x80', '\x80', '\x80', '\x81'}) text += {'\x88', component};
    }
    return {"small picture", test::bytes_of(text)};
}

std::vector<Seed> draco_seeds() {
    std::vector<Seed> result;
    for (const int rings : {1, 8}) {
        const scene::Mesh mesh = scene::build_mesh(
            scene::DiscRecipe{.inner_radius = 0.02, .outer_radius = 0.06, .rings = rings, .segments = 12});
        const std::vector<char> stream = scene::encode_draco(mesh).bytes;
        result.push_back(
            {"disc of " + std::to_string(rings) + " rings", test::bytes_of({stream.data(), stream.size()})});
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

constexpr const char* kFilm = R"({"film": {"ior": 1.33, "thickness_nm": 400}, "base": {"ior": 1.5, "k": 0.1}})";
constexpr const char* kLayers =
    R"({"film": [{"ior": 1.4, "thickness_nm": 90}], "metal": "Al", "roughness": 0.2, "illuminant": "F11"})";
constexpr const char* kIridescence =
    R"({"iridescenceFactor": 0.5, "iridescenceIor": 1.4, "iridescenceThicknessMaximum": 300,
        "iridescenceThicknessTexture": {"index": 1, "extensions": {"KHR_texture_transform": {"scale": [2, 3]}}},
        "extras": {"metal": "Au"}})";

Seed written(std::string_view text) {
    return {std::string(text), test::bytes_of(text)};
}

Seed cooked_film() {
    const nlohmann::json json = nlohmann::json::parse(kFilm);
    return {"cooked film", thin_film::write_cooked_film(json, thin_film::cook_film(json, "seed.json"))};
}

/// Those that are made, not read.
std::vector<Seed> made_seeds(std::string_view format) {
    if (format == "draco") return draco_seeds();
    if (format == "cooked-material") return cooked_seeds();
    if (format == "film") return {written(kFilm), written(kLayers)};
    if (format == "iridescence") return {written(kIridescence)};
    if (format == "cooked-film") return {cooked_film()};
    if (format == "cooked-probe") return {{"clear sky", cooked_probe()}};
    if (format == "recording") return {recording()};
    if (format == "plan") return {plan()};
    if (format == "exr") return {small_exr()};
    if (format == "hdr") return {small_hdr()};
    if (format != "cooked") return {};
    std::vector<Seed> result;
    for (Seed& seed : cooked_seeds()) result.push_back({seed.name, packed(std::move(seed.bytes))});
    return result;
}

template <typename Chosen>
void add_files(const fs::path& folder, const Chosen& chosen, std::vector<Seed>& seeds) {
    if (!fs::exists(folder)) return;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.file_size() <= kLargestSeed && chosen(entry.path()))
            seeds.push_back({entry.path().string(), read_file(entry.path(), kLargestSeed)});
}

}  // namespace

std::vector<Seed> seeds(const Format& format) {
    std::vector<Seed> result = made_seeds(format.name);
    add_files(
        test::source_path("tests/fuzz/corpus") / format.name, [](const fs::path&) { return true; }, result);
    for (const fs::path& folder : folders())
        add_files(
            folder, [&](const fs::path& path) { return is_of(format, path); }, result);
    std::sort(result.begin(), result.end(), [](const Seed& a, const Seed& b) { return a.name < b.name; });
    return result;
}

}  // namespace rowland::fuzz
