#include "editor/inspector/layout.h"

#include <algorithm>

#include "editor/inspector/field.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/system.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestLayout = 1 << 16;

/// Calls `visit(key, member, least, most)` for every number of a layout.
template <typename AnyLayout, typename Visit>
void visit_numbers(AnyLayout& layout, Visit&& visit) {
    visit("width", layout.width, 640, 16384);
    visit("height", layout.height, 400, 16384);
    visit("scale", layout.scale, 0.5F, 4.0F);
    visit("material_width", layout.material_width, 12.0F, 60.0F);
    visit("physics_width", layout.physics_width, 12.0F, 80.0F);
    visit("price_height", layout.price_height, 4.0F, 60.0F);
    visit("rotation_deg", layout.stage.rotation_deg, -180.0F, 180.0F);
    visit("exposure_stops", layout.stage.exposure_stops, -16.0F, 16.0F);
    visit("lamp_azimuth_deg", layout.stage.lamp_azimuth_deg, -180.0F, 180.0F);
    visit("lamp_elevation_deg", layout.stage.lamp_elevation_deg, 0.0F, 90.0F);
    visit("lamp_irradiance", layout.stage.lamp_irradiance, 0.0F, 100.0F);
}

}  // namespace

void remember(Layout& layout, const std::filesystem::path& path) {
    constexpr std::size_t kMost = 10;
    const std::string name = std::filesystem::absolute(path).lexically_normal().string();
    std::erase(layout.recent, name);
    layout.recent.insert(layout.recent.begin(), name);
    if (layout.recent.size() > kMost) layout.recent.pop_back();
}

Layout load_layout(const std::filesystem::path& path) {
    Layout layout;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return layout;
    try {
        const Json json = parse_ordered(read_text_file(path, kLargestLayout), path.string());
        if (!json.is_object()) return layout;
        visit_numbers(layout, [&]<typename T>(const char* key, T& value, T least, T most) {
            if (json.contains(key) && json[key].is_number()) value = std::clamp(json[key].get<T>(), least, most);
        });
        layout.stage.lamp = json.value("lamp", false);
        layout.shape = json.value("shape", layout.shape);
        layout.light = json.value("light", layout.light);
        layout.unsaved = json.value("unsaved", layout.unsaved);
        layout.recent = json.value("recent", layout.recent);
    } catch (const std::exception& error) {
        log_warning("{}: using the default layout: {}", path.string(), error.what());
        return {};
    }
    return layout;
}

void save_layout(const Layout& layout, const std::filesystem::path& path) {
    Json json = {{"shape", layout.shape},
                 {"light", layout.light},
                 {"unsaved", layout.unsaved},
                 {"recent", layout.recent},
                 {"lamp", layout.stage.lamp}};
    visit_numbers(layout, [&](const char* key, auto value, auto, auto) { json[key] = value; });
    // A path need not be UTF-8.
    write_file_atomic(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::optional<std::filesystem::path> default_layout_file() {
    if (const auto folder = settings_folder()) return *folder / "rowland" / "inspector.json";
    return std::nullopt;
}

}  // namespace rowland::inspector
