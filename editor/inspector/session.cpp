#include "editor/inspector/session.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/app/unused_file.h"
#include "engine/view/capture.h"

namespace rowland::inspector {

namespace {

constexpr int kSweepBands = 5;
constexpr int kSweepViews = 61;

const std::array kPresets = {"cd",         "cd_pressed",       "cd_r", "dvd", "blu_ray", "ruled_600",
                             "ruled_1200", "holographic_foil", "vinyl"};

/// On which a preset shows its colours at first sight. The sheet is bent, so that light and eye are nearly along the
/// surface somewhere: only there the finest grooves send light, and the coarsest reflect a streak.
PreviewShape shape_of_preset(const std::string& name) {
    return name.starts_with("cd") || name == "dvd" ? PreviewShape::Disc : PreviewShape::Sheet;
}

/// The members of a quality that choose among representations; the others hold for every choice.
Json choice_of_quality(Json quality) {
    for (const char* other : {"max_error", "measure", "surface", "illuminant", "probes"}) quality.erase(other);
    return quality;
}

bool is_table(const diffraction::Grating& grating) {
    return std::holds_alternative<diffraction::EfficiencyTable>(grating.profile);
}

}  // namespace

Session::Session(const post::OcioConfig& config, SessionSettings settings)
    : settings_(std::move(settings)),
      preview_(config, settings_.still),
      document_(Document::open_as_new(settings_.content_folder / "materials" / "cd.json")),
      cook_(std::make_shared<GratingCook>(nullptr)) {
    choose_shape(PreviewShape::Disc);
}

void Session::open(const std::filesystem::path& path) {
    const std::string file = path.filename().string();
    messages_.attempt([&] {
        if (is_scene_file(path)) {
            opening_of_ = std::make_shared<const std::filesystem::path>(path);
            return;
        }
        if (is_picture_file(path)) return set_groove_picture(path);
        OpenedFile opened = open_file(path);
        if (auto* document = std::get_if<Document>(&opened)) {
            use_material(std::move(*document), path);
        } else if (auto* table = std::get_if<diffraction::EfficiencyTable>(&opened)) {
            opened_table_ = std::move(*table);
            messages_.say(file + ": compared with the efficiencies of the profile");
        } else {
            choose_light(path);
        }
    });
}

void Session::open_preset(const std::string& name) {
    const std::filesystem::path path = preset_path(name);
    const bool opened = messages_.attempt([&] { use_material(Document::open_as_new(path), path); });
    if (opened && !document_.is_scene()) choose_shape(shape_of_preset(name));
}

void Session::adopt(Document document) {
    document_ = std::move(document);
    all_prices_.reset();
    pinned_price_.reset();
    drop_scene();
    if (document_.is_scene()) return;
    messages_.say(document_.name() + (document_.path().empty() ? ": the start of a new material" : ": opened"));
}

void Session::save(bool over_changes) {
    asks_to_overwrite = !over_changes && document_.changed_outside();
    if (asks_to_overwrite) return messages_.say(document_.name() + ": changed by another program since it was opened");
    if (messages_.attempt([&] { document_.save(over_changes); })) messages_.say(document_.path().string() + ": saved");
}

void Session::save_as(const std::filesystem::path& path) {
    if (messages_.attempt([&] { document_.save_as(path); })) messages_.say(path.string() + ": saved");
}

void Session::write_screenshot(const gpu::Framebuffer& picture) {
    const std::filesystem::path path = app::unused_file(std::filesystem::current_path(), "screenshot", ".png");
    if (messages_.attempt([&] { view::write_display_capture(picture, path); }))
        messages_.say(path.string() + ": the window");
}

void Session::choose_light(const std::filesystem::path& path) {
    chosen_light_ = std::make_shared<const LightSource>(LightSource{path});
}

void Session::choose_mapping(const std::string& mapping) {
    settings_.probe_mapping = mapping;
    if (chosen_light_) choose_light(chosen_light_->path);
}

void Session::choose_shape(PreviewShape shape) {
    if (shape == PreviewShape::Model) {
        if (!scene_on_gpu_) return;
        object_ = scene_on_gpu_;
    } else {
        object_ = std::make_shared<const PreviewObject>(PreviewObject{
            shape, {.meshes = {render::make_mesh_instance(preview_mesh(shape))}, .materials = {}}, nullptr});
    }
    picked_.reset();
    surface_.reset();
}

template <typename Key, typename Value>
bool Session::poll(Computed<Key, Value>& computed) {
    const auto change = computed.poll();
    if (!change.failure.empty()) messages_.say(change.failure, true);
    news_ = news_ || change.value || !change.failure.empty();
    return change.value;
}

bool Session::update() {
    news_ = false;
    want_opening();
    take_opened(opening_.poll());
    const auto cooking = [this](auto& computed, const std::shared_ptr<const MaterialSource>& source) {
        computed.want(source ? std::optional(source) : std::nullopt,
                      [cook = cook_, source](auto&&...) { return cook->cook(*source); });
    };
    cooking(cooked_, document_.accepted());
    cooking(saved_, document_.saved());
    if (poll(cooked_) && !is_table(cooked_.value()->get()->material->material.grating))
        last_scalar_ = cooked_.value()->get()->material->material.grating;
    news_ = saved_.poll().value || news_;  // its failure is that of cooked_
    news_ = gratings_.update(document_, cook_, cooked_.current() ? *cooked_.value() : nullptr) || news_;
    for (std::string& failure : gratings_.take_failures()) messages_.say(std::move(failure), true);

    light_.want(chosen_light_ ? std::optional(chosen_light_) : std::nullopt,
                [source = chosen_light_, mapping = settings_.probe_mapping](const std::stop_token& stop, auto&&) {
                    Light light = load_light(source->path, mapping);
                    return stop.stop_requested() ? std::nullopt : std::optional(std::move(light));
                });
    if (poll(light_))
        messages_.say(light()->path.filename().string() + ": the light" +
                      (light()->image.mapping() == lighting::Mapping::Angular ? ", an angular map" : ""));

    want_pattern();
    poll(pattern_);
    want_point_numbers();
    poll(point_);
    want_prices();
    poll(all_prices_);
    poll(pinned_price_);
    use_budget();
    const bool before = std::exchange(was_busy_, busy());
    return news_ || was_busy_ != before;
}

void Session::want_pattern() {
    const auto& source = document_.accepted();
    pattern_.want(
        source && source->material.grating.lattice ? std::optional(source) : std::nullopt,
        [source](auto&&...) { return std::make_shared<const PatternFigure>(pattern_figure(source->material)); });
}

void Session::want_point_numbers() {
    std::optional<PointInputs> inputs;
    if (cooked_.current() && light() && preview_.drawn()) inputs = point_inputs();
    if (point_.wants(inputs)) return;  // before the surface is searched for the point
    if (!inputs) return point_.want(inputs, nullptr);
    const diffraction::ShadingPoint frame = inputs->surface ? *inputs->surface : middle_frame();
    point_.want(inputs,
                [cooked = inputs->cooked, light = inputs->light, frame](const std::stop_token& stop,
                                                                        auto&&) -> std::optional<PointNumbers> {
                    PointNumbers numbers;
                    numbers.radiance = point_radiance(*cooked, light->image, light->divided, frame);
                    if (!stop.stop_requested())
                        numbers.sweep =
                            view_sweep(*cooked, light->image, light->divided, frame, kSweepBands, kSweepViews, stop);
                    if (stop.stop_requested()) return std::nullopt;
                    return numbers;
                });
}

bool Session::busy() const {
    const auto& source = document_.accepted();
    return !cooked_.wants(source ? std::optional(source) : std::nullopt) || cooked_.busy() || opening_of_ ||
           gratings_.busy() || saved_.busy() || light_.busy() || pattern_.busy() || point_.busy() || pricing();
}

void Session::draw(glm::ivec2 size, const scene::Camera& camera, bool with_saved, float seconds) {
    if (!ready() || size.x < 1 || size.y < 1) return;
    const std::size_t chosen = object_->scene ? document_.chosen() : 0;
    messages_.attempt([&] {
        preview_.show({.size = size,
                       .eye = camera.eye,
                       .target = camera.target,
                       .stage = stage,
                       .object = object_,
                       .light = light(),
                       .gratings = shown_with(cooked_),
                       .saved = with_saved && saved() ? std::optional(shown_with(saved_)) : std::nullopt,
                       .grooves_of = shows_grooves ? std::optional(chosen) : std::nullopt,
                       .glare_of = looks_through ? std::optional(chosen) : std::nullopt});
    });
    preview_.draw(seconds);
    update_surface();
    if (picked_ && pixel_inputs_ != PixelInputs{point_inputs(), stage}) read_picked_pixel();
}

void Session::read_picked_pixel() {
    pixel_inputs_ = {point_inputs(), stage};
    const glm::ivec2 size = preview_.display().size();
    const glm::ivec2 pixel = glm::min(glm::ivec2(picked_->at * glm::vec2(size)), size - 1);
    const auto index =
        static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(pixel.x);
    picked_->working = glm::vec3(preview_.linear().read_rgba_float()[index]);
    const std::vector<std::uint8_t> display = preview_.display().read_rgba8();
    picked_->display = {display[4 * index], display[4 * index + 1], display[4 * index + 2]};
}

std::optional<diffraction::Grating> Session::compared() const {
    if (!document_.has_grating()) return std::nullopt;
    diffraction::Grating other = document_.material().grating;
    if (is_table(other) && last_scalar_) return last_scalar_;
    if (!opened_table_) return std::nullopt;
    other.profile = *opened_table_;
    other.metal.reset();
    other.normalization = diffraction::Normalization::Energy;
    return other;
}

Session::PriceInputs Session::price_inputs(bool of_all) const {
    PriceInputs inputs{document_.has_grating() ? document_.accepted()->json : Json(), light()};
    for (const char* of_mesh : {"grooveRotation", "grooveTexture"})
        if (inputs.material.contains(of_mesh)) inputs.material.erase(of_mesh);
    if (of_all && inputs.material.contains("quality")) {
        Json& quality = inputs.material["quality"];
        const Json choice = choice_of_quality(quality);
        for (const auto& [key, value] : choice.items()) quality.erase(key);
        quality.erase("max_error");
    }
    return inputs;
}

Session::PriceWork Session::price_work(bool present_only) const {
    return [source = document_.accepted(), light = light(), present_only](
               const std::stop_token& stop, const auto& publish) -> std::optional<PriceList> {
        PriceList last;
        const auto report = [&](const PriceList& list) { publish(last = list); };
        report(last);
        const bool has_quality = source->json.contains("quality");
        price_choices({.material = source->material,
                       .quality = has_quality ? nlohmann::json(source->json["quality"]) : nlohmann::json(),
                       .probe = light->image,
                       .key_lights = light->key_lights,
                       .surface = source->material.quality.surface,
                       .present_only = present_only},
                      report, stop);
        return stop.stop_requested() ? std::nullopt : std::optional(last);
    };
}

void Session::want_prices() {
    if (!light() || !document_.has_grating()) return;
    const bool asked = measure_all_of_ == price_inputs(true);
    all_prices_.want(asked ? measure_all_of_ : std::nullopt, price_work(false));

    const PriceList list = prices();
    const bool measured =
        prices_are_current() && std::any_of(list.choices.begin(), list.choices.end(),
                                            [](const PricedChoice& choice) { return choice.present; });
    const bool idle = point_.current() && !point_.busy() && !all_prices_.busy();
    const bool pinned = document_.material().quality.pinned.has_value();
    PriceInputs inputs = price_inputs(false);
    const bool wanted = pinned && !measured && idle && stopped_price_of_ != inputs;
    pinned_price_.want(wanted ? std::optional(std::move(inputs)) : std::nullopt, price_work(true));
}

void Session::stop_pricing() {
    budget_.reset();
    measure_all_of_.reset();
    stopped_price_of_ = price_inputs(false);
}

PriceList Session::prices() const {
    if (!document_.has_grating()) return {};
    const bool all_current = all_prices_.is_of(price_inputs(true));
    const bool pinned_current = pinned_price_.is_of(price_inputs(false));
    if (!all_current && (pinned_current || all_prices_.value() == nullptr))
        return pinned_price_.value() != nullptr ? *pinned_price_.value() : PriceList();
    PriceList list = *all_prices_.value();
    if (!all_current) return list;
    const nlohmann::json present = choice_of_quality(value_of(field_at("/quality"), document_.accepted()->json));
    bool found = false;
    for (PricedChoice& choice : list.choices)
        found |= choice.present = nlohmann::json(choice_of_quality(choice.settings)) == present;
    if (!found && pinned_current && !pinned_price_.value()->choices.empty())
        list.choices.insert(list.choices.begin(), pinned_price_.value()->choices.front());
    return list;
}

void Session::choose_priced(const PricedChoice& choice) {
    Json quality = choice.settings;
    const Json before = value_of(field_at("/quality"), document_.json());
    if (before.contains("illuminant")) quality["illuminant"] = before["illuminant"];
    document_.replace_quality(quality);
}

void Session::cook_to_budget(double max_error) {
    budget_ = max_error;
    if (!all_measured()) price();
}

bool Session::all_measured() const {
    return all_prices_.is_of(price_inputs(true)) && all_prices_.value()->total > 0 &&
           all_prices_.value()->done == all_prices_.value()->total;
}

/// Does what cook_to_budget() was asked for.
void Session::use_budget() {
    if (!budget_ || !light()) return;
    if (all_measured()) {
        const double max_error = *std::exchange(budget_, std::nullopt);
        if (const auto choice = cheapest_within(prices(), max_error))
            choose_priced(*choice);
        else
            messages_.say("no choice is within that error: allow more", true);
    } else if (measure_all_of_ != price_inputs(true)) {
        budget_.reset();
        messages_.say("an edit ended the measurement: cook to budget again");
    } else if (!all_prices_.busy()) {
        budget_.reset();  // the measurement failed, which was said
    }
}

std::span<const char* const> Session::presets() {
    return kPresets;
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
