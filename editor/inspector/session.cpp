#include "editor/inspector/session.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/asset/efficiency_csv.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::inspector {

namespace {

constexpr std::chrono::milliseconds kDebounce(60);
constexpr std::chrono::milliseconds kRest(700);  ///< without an edit, before the present error is measured
constexpr std::uint64_t kLargestSource = 16 << 20;
constexpr int kSweepBands = 5;
constexpr int kSweepViews = 61;
constexpr std::size_t kMostMessages = 50;
constexpr int kFramesToFill = 90;  ///< that maps take to fill, with room

const std::array kPresets = {"cd", "dvd", "blu_ray", "ruled_600", "ruled_1200", "holographic_foil", "vinyl"};

std::shared_ptr<const diffraction::CookedMaterial> cook(const Json& material, const std::string& name,
                                                        const std::filesystem::path& folder) {
    return std::make_shared<const diffraction::CookedMaterial>(
        diffraction::cook_material(nlohmann::json::parse(material.dump()), name, diffraction::read_beside(folder)));
}

bool is_probe_image(const std::filesystem::path& path) {
    return path.extension() == ".hdr" || path.extension() == ".exr" || path.extension() == ".pic";
}

bool is_probe_recipe(const std::filesystem::path& path) {
    const nlohmann::json json = parse_json(read_text_file(path, kLargestSource), path.string());
    return json.is_object() && json.contains("probe");
}

/// The material of the first grating in a glTF file, as a document of its own; nothing if it has none.
std::optional<Json> grating_of(const scene::ImportedScene& scene) {
    for (const scene::MaterialDescription& description : scene.materials) {
        const auto found = description.extensions.find(diffraction::kGltfExtension);
        if (found == description.extensions.end()) continue;
        Json material = Json::object();
        for (const char* part : {"grating", "metal", "base", "quality"})
            if (found->second.contains(part)) material[part] = Json::parse(found->second[part].dump());
        return material;
    }
    return std::nullopt;
}

}  // namespace

Session::Session(const post::OcioConfig& config, SessionSettings settings)
    : settings_(std::move(settings)),
      preview_(config, settings_.still),
      document_(Document::open_as_new(settings_.content_folder / "materials" / "cd.json")) {}

template <typename F>
bool Session::attempt(F&& action) {
    try {
        action();
        return true;
    } catch (const std::exception& error) {
        say(error.what(), true);
        return false;
    }
}

void Session::say(std::string text, bool failure) {
    if (failure)
        log_error("{}", text);
    else
        log_info("{}", text);
    messages_.push_back({std::move(text), failure});
    if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
}

void Session::open(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    attempt([&] {
        if (extension == ".gltf" || extension == ".glb")
            open_gltf(path);
        else if (extension == ".csv")
            open_table(path);
        else if (is_probe_image(path) || extension == ".probe" || is_probe_recipe(path))
            choose_light(path);
        else
            adopt_document(Document::open(path));
    });
}

void Session::open_preset(const std::string& name) {
    attempt([&] { adopt_document(Document::open_as_new(settings_.content_folder / "materials" / (name + ".json"))); });
}

void Session::open_gltf(const std::filesystem::path& path) {
    const std::array<std::string, 1> handled = {diffraction::kGltfExtension};
    const scene::ImportedScene imported = scene::load_gltf(path, handled);
    scene::Mesh mesh = fitted_model(scene::merge_instances(imported));
    std::optional<Document> document;
    if (auto material = grating_of(imported))
        document = Document::make_new(std::move(*material), path.filename().string(),
                                      std::filesystem::absolute(path).parent_path());
    model_ = std::move(mesh);
    choose_shape(PreviewShape::Model);
    if (document)
        adopt_document(std::move(*document));
    else
        say(path.filename().string() + ": it has no grating; it is shown with the material that is open", false);
}

void Session::open_table(const std::filesystem::path& path) {
    diffraction::Grating other = document_.material().grating;
    other.profile =
        diffraction::parse_efficiency_csv(read_text_file(path, diffraction::kMaximumNamedFileSize), path.string());
    other.metal.reset();
    other.normalization = diffraction::Normalization::Energy;
    compared_ = std::move(other);
    say(path.filename().string() + ": laid beside the profile's own efficiencies", false);
}

void Session::adopt_document(Document document) {
    document_ = std::move(document);
    asked_version_ = 0;
    seen_version_ = 0;
    saved_asked_.reset();
    stop_pricing();
    priced_version_ = 0;
    prices_ = std::make_shared<SharedPrices>();
    say(document_.name() + (document_.path().empty() ? ": a start for a new material" : ": opened"), false);
}

void Session::save() {
    if (attempt([&] { document_.save(); })) say(document_.path().string() + ": saved", false);
}

void Session::save_as(const std::filesystem::path& path) {
    if (attempt([&] { document_.save_as(path); })) say(path.string() + ": saved", false);
}

void Session::choose_light(const std::filesystem::path& path) {
    light_task_.start(
        [path, mapping = settings_.probe_mapping](const std::stop_token&) { return load_light(path, mapping); });
}

void Session::choose_shape(PreviewShape shape) {
    if (shape == PreviewShape::Model && !model_) return;
    preview_.set_shape(shape, model_);
    shape_ = shape;
    picked_.reset();
    ++slow_reasons_;
}

void Session::start_cooking() {
    if (document_.version() != seen_version_) {
        if (!std::holds_alternative<diffraction::EfficiencyTable>(document_.material().grating.profile) && compared_ &&
            !std::holds_alternative<diffraction::EfficiencyTable>(compared_->profile))
            compared_.reset();
        seen_version_ = document_.version();
        last_edit_ = std::chrono::steady_clock::now();
        stop_pricing();
    }
    const bool settled = settings_.still || !cooked_ || std::chrono::steady_clock::now() - last_edit_ >= kDebounce;
    if (asked_version_ != document_.version() && (settled || !cook_task_.busy())) {
        asked_version_ = document_.version();
        cook_task_.start([material = document_.good_json(), name = document_.name(), folder = document_.folder()](
                             const std::stop_token&) { return cook(material, name, folder); });
    }
    const Json* saved = document_.saved();
    if (saved != nullptr && saved_asked_ != *saved) {
        saved_asked_ = *saved;
        saved_task_.start([material = *saved, name = document_.name(), folder = document_.folder()](
                              const std::stop_token&) { return cook(material, name, folder); });
    } else if (saved == nullptr && preview_.has_saved()) {
        preview_.set_saved(nullptr);
    }
}

void Session::update() {
    start_cooking();
    if (auto outcome = cook_task_.poll()) {
        if (outcome->value) {
            // A table laid aside is the rigorous twin of the next scalar profile, and the other way round.
            const bool table =
                std::holds_alternative<diffraction::EfficiencyTable>((*outcome->value)->material.grating.profile);
            if (cooked_ && table &&
                !std::holds_alternative<diffraction::EfficiencyTable>(cooked_->material.grating.profile))
                compared_ = cooked_->material.grating;
            cooked_ = std::move(*outcome->value);
            attempt([&] { preview_.set_material(cooked_); });
            ++cooked_count_;
        } else {
            say(outcome->failure, true);
        }
    }
    if (auto outcome = saved_task_.poll(); outcome && outcome->value) preview_.set_saved(*outcome->value);
    if (auto outcome = light_task_.poll()) {
        if (outcome->value) {
            light_ = std::move(*outcome->value);
            attempt([&] { preview_.set_light(light_); });
            say(light_->path.filename().string() + ": the light", false);
            stop_pricing();
            ++slow_reasons_;
        } else {
            say(outcome->failure, true);
        }
    }
    if (auto outcome = slow_task_.poll()) {
        if (outcome->value)
            slow_ = std::move(*outcome->value);
        else
            say(outcome->failure, true);
    }
    if (auto outcome = price_task_.poll(); outcome && !outcome->value) say(outcome->failure, true);
    start_slow_numbers();
    const bool idle = cooked_ && !cook_task_.busy() && !slow_task_.busy() && !price_task_.busy();
    if (idle && slow_ && rested() && document_.material().quality.pinned && !prices_are_current()) start_pricing(true);
}

void Session::start_slow_numbers() {
    const std::uint64_t reasons = slow_reasons_ + cooked_count_;
    if (!cooked_ || !light_ || drawn_ == 0 || cook_task_.busy() || slow_asked_ == reasons) return;
    slow_asked_ = reasons;
    slow_task_.start([cooked = cooked_, light = light_, frame = picked_ ? picked_->frame : middle_frame(),
                      count = cooked_count_](const std::stop_token& stop) {
        SlowNumbers numbers;
        numbers.of_material = count;
        numbers.point = point_radiance(*cooked, light->image, light->divided, frame);
        if (!stop.stop_requested())
            numbers.sweep = view_sweep(*cooked, light->image, light->divided, frame, kSweepBands, kSweepViews, stop);
        return numbers;
    });
}

/// A point of the surface near the middle of the picture; straight on if nothing is there.
diffraction::Frame Session::middle_frame() const {
    for (const glm::vec2 at : {glm::vec2(0.66F, 0.5F), glm::vec2(0.5F, 0.5F), glm::vec2(0.5F, 0.68F)})
        if (auto frame = preview_.pick(at)) return *frame;
    return {};
}

bool Session::busy() const {
    return cook_task_.busy() || saved_task_.busy() || light_task_.busy() || slow_task_.busy() || price_task_.busy() ||
           asked_version_ != document_.version();
}

void Session::draw(glm::ivec2 size, const scene::Camera& camera, bool with_saved, float seconds) {
    if (!preview_.ready() || size.x < 1 || size.y < 1) return;
    const PictureKey key{size,         camera.eye, camera.target,       stage, with_saved, cooked_count_,
                         light_.get(), shape_,     preview_.has_saved()};
    unchanged_ = key == picture_key_ ? unchanged_ + 1 : 0;
    picture_key_ = key;
    // Maps fill by and by; then the picture is what it was.
    if (unchanged_ > kFramesToFill) return;
    preview_.draw(size, camera, stage, with_saved, seconds);
    ++drawn_;
    if (picked_ && picked_of_draw_ != cooked_count_ + slow_reasons_) read_picked_pixel();
}

void Session::pick(const glm::vec2& at) {
    if (drawn_ == 0) return;
    const auto frame = preview_.pick(at);
    if (!frame) return;
    picked_ = PickedPixel{.at = at, .frame = *frame};
    ++slow_reasons_;
    read_picked_pixel();
}

void Session::read_picked_pixel() {
    picked_of_draw_ = cooked_count_ + slow_reasons_;
    const glm::ivec2 size = preview_.display().size();
    const glm::ivec2 pixel = glm::min(glm::ivec2(picked_->at * glm::vec2(size)), size - 1);
    const auto index =
        static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(pixel.x);
    picked_->working = glm::vec3(preview_.linear().read_rgba_float()[index]);
    const std::vector<std::uint8_t> display = preview_.display().read_rgba8();
    picked_->display = {display[4 * index], display[4 * index + 1], display[4 * index + 2]};
}

bool Session::rested() const {
    return settings_.still || std::chrono::steady_clock::now() - last_edit_ >= kRest;
}

void Session::start_pricing(bool present_only) {
    if (!light_) return;
    priced_version_ = document_.version();
    priced_light_ = light_;
    prices_ = std::make_shared<SharedPrices>();
    nlohmann::json quality;
    if (document_.good_json().contains("quality"))
        quality = nlohmann::json::parse(document_.good_json()["quality"].dump());
    price_task_.start([shared = prices_, material = document_.material(), quality, light = light_,
                       present_only](const std::stop_token& stop) {
        price_choices(
            {.material = material,
             .quality = quality,
             .probe = light->image,
             .key_lights = light->key_lights,
             .surface = material.quality.surface,
             .present_only = present_only},
            [&](const PriceList& list) {
                const std::scoped_lock guard(shared->lock);
                shared->list = list;
            },
            stop);
        return 0;
    });
}

PriceList Session::prices() const {
    const std::scoped_lock guard(prices_->lock);
    return prices_->list;
}

void Session::choose_priced(const PricedChoice& choice) {
    const bool current = prices_are_current();
    Json quality = Json::parse(choice.settings.dump());
    const Json before = value_of(field_at("/quality"), document_.json());
    if (before.contains("illuminant")) quality["illuminant"] = before["illuminant"];
    document_.replace_quality(quality);
    if (!current) return;
    // What was priced is what is priced still: only its choice has changed.
    priced_version_ = document_.version();
    seen_version_ = document_.version();
    const std::scoped_lock guard(prices_->lock);
    for (PricedChoice& other : prices_->list.choices) other.present = other.settings == choice.settings;
}

void Session::cook_to_budget(double max_error) {
    if (const auto choice = cheapest_within(prices(), max_error))
        choose_priced(*choice);
    else
        say("nothing measured is within that error: measure all choices, or allow more", true);
}

std::vector<std::string> Session::presets() const {
    return {kPresets.begin(), kPresets.end()};
}

std::vector<std::filesystem::path> Session::shipped_lights() const {
    std::vector<std::filesystem::path> result;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(settings_.content_folder / "probes", ignored))
        if (entry.path().extension() == ".json") result.push_back(entry.path());
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace rowland::inspector
