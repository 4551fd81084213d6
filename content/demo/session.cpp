#include "content/demo/session.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "content/demo/play/body.h"
#include "content/demo/play/play.h"
#include "engine/app/drawing_program.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/text.h"
#include "engine/scene/transform.h"
#include "engine/view/picture.h"
#include "modules/diffraction/runtime/rung_control.h"
#include "modules/material_types.h"

namespace rowland::demo {

namespace {

constexpr float kExposureStep = 0.25F;
constexpr int kFramesBetweenShaderChecks = 10;

template <typename T>
void toggle(std::optional<T>& effect, const T& settings = {}) {
    if (effect)
        effect.reset();
    else
        effect = settings;
}

/// The element after `present`; the first one after the last, or if `present` is none of them.
template <typename T>
const T& next_in(const std::vector<T>& list, const T& present) {
    const auto at = std::ranges::find(list, present);
    return at == list.end() || at + 1 == list.end() ? list.front() : *(at + 1);
}

post::PostSettings post_settings(const Options& options) {
    post::PostSettings settings;
    settings.exposure_stops = options.exposure_stops;
    if (options.bloom > 0.0F) settings.bloom = post::BloomSettings{.strength = options.bloom};
    if (options.auto_exposure) settings.auto_exposure = post::AutoExposureSettings{};
    if (options.vignette > 0.0F)
        settings.vignette = post::VignetteSettings{.vertical_fov = kFieldOfView, .strength = options.vignette};
    if (options.f_number)
        settings.depth_of_field = post::DepthOfFieldSettings{.f_number = *options.f_number, .focus_m = options.focus_m};
    if (options.grain > 0.0F) settings.grain = post::GrainSettings{.strength = options.grain};
    if (options.dither) settings.dither = post::DitherSettings{};
    return settings;
}

render::Effects effects(const Options& options) {
    render::Effects effects;
    if (options.ambient_occlusion) effects.ambient_occlusion = render::AmbientOcclusionSettings{};
    if (options.soft_shadows) effects.soft_shadows = render::SoftShadowSettings{};
    effects.local_reflections = options.local_reflections;
    effects.object_reflections = options.local_reflections;
    effects.rough_reflections = options.rough_reflections;
    return effects;
}

diffraction::DiffractionSettings diffraction_settings(const Options& options, Pace pace,
                                                      std::chrono::milliseconds map_wait) {
    diffraction::DiffractionSettings settings;
    if (options.light_window != "auto") settings.window = math::parse_window(options.light_window);
    settings.map_pace = pace == Pace::Still ? diffraction::MapPace::Whole : diffraction::MapPace::Incremental;
    settings.map_wait = map_wait;
    return settings;
}

/// A picture that shows diffraction, with the effects that the options ask for.
std::unique_ptr<view::Picture> open_picture(const Options& options, const post::OcioConfig& config, glm::ivec2 size,
                                            Pace pace, std::chrono::milliseconds map_wait) {
    auto picture = std::make_unique<view::Picture>(config, std::string(), size);
    picture->post_settings() = post_settings(options);
    picture->renderer().set_effects(effects(options));
    modules::register_material_types(picture->renderer(),
                                     {.diffraction = diffraction_settings(options, pace, map_wait)});
    return picture;
}

}  // namespace

Session::Session(const Options& options, const post::OcioConfig& config, glm::ivec2 pixels, glm::ivec2 window,
                 Pace pace, std::chrono::milliseconds map_wait)
    : options_(options),
      config_(config),
      picture_(open_picture(options, config, pixels, pace, map_wait)),
      assets_(open_assets(options)),
      scene_(options, assets_, picture_->renderer(), picture_->xyz_to_working()),
      play_(scene_.world(), scene_.toys(), scene_.camera(), scene_.room(), window),
      comparison_(scene_.world(), picture_->xyz_to_working()),
      shaders_(picture_->shader_sources(options.shader_folder)),
      probe_paths_(probe_paths(options)),
      views_(config.views(config.default_display())),
      view_(config.default_view(config.default_display())),
      sheets_(sheets(options, scene_)),
      plays_back_(options.play.has_value()) {
    play_.set_animation([this](const Play& play) { scene_.pose(play); });
    use_probe(probe_paths_[0]);
    set_budget(options.gratings_ms.value_or(0.0));
    if (options.glare || scene_.sheet() != nullptr) look_through(1);
}

std::vector<Action> Session::carry_out() {
    std::vector<Action> unknown;
    for (const Play::Command& command : play_.take_commands())
        messages_.attempt([&] {
            if (const auto* setting = std::get_if<SettingEvent>(&command))
                set(*setting);
            else if (const Action action = std::get<Action>(command); !perform(action))
                unknown.push_back(action);
        });
    return unknown;
}

void Session::set(const SettingEvent& event) {
    post::PostSettings& post = picture_->post_settings();
    const auto number = [&] { return static_cast<float>(std::get<double>(event.value)); };
    const auto text = [&]() -> const std::string& { return std::get<std::string>(event.value); };
    switch (event.setting) {
        case Setting::Exposure:
            post.exposure_stops = number();
            break;
        case Setting::Bloom:
            if (post.bloom) post.bloom->strength = number();
            break;
        case Setting::Vignette:
            if (post.vignette) post.vignette->strength = number();
            break;
        case Setting::FNumber:
            if (post.depth_of_field) post.depth_of_field->f_number = number();
            break;
        case Setting::GratingsMs:
            set_budget(number());
            break;
        case Setting::Rung:
            if (plays_back_)
                scene_.world().add(grating_numbered(event.object),
                                   diffraction::RecordedRung{static_cast<std::size_t>(number())});
            break;
        case Setting::Grain:
            if (post.grain) post.grain->strength = number();
            break;
        case Setting::Wipe:
            comparison_.set_wiping(number() > 0.0F);
            break;
        case Setting::WipeLine:
            comparison_.set_line(number());
            break;
        case Setting::Probe:
            use_probe(probe_named(text()));
            messages_.say(probe_path_.filename().string() + ": the light");
            break;
        case Setting::View:
            use_view(text());
            break;
        case Setting::LeftLook:
            set_look(Side::Left, event.object, text());
            break;
        case Setting::RightLook:
            set_look(Side::Right, event.object, text());
            break;
    }
}

ecs::Entity Session::grating_numbered(const std::string& text) {
    const std::vector<ecs::Entity> gratings = comparison_.gratings();
    std::size_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [read, failure] = std::from_chars(text.data(), end, number);
    if (failure != std::errc() || read != end || number >= gratings.size())
        refuse_input("rung", "of", text, fmt::format("the number of one of {} gratings", gratings.size()));
    return gratings[number];
}

/// A shipped probe by its stem, any other by its path.
std::filesystem::path Session::probe_named(const std::string& name) const {
    const auto found = std::ranges::find(probe_paths_, name, [](const auto& path) { return path.stem().string(); });
    return found == probe_paths_.end() ? std::filesystem::path(name) : *found;
}

void Session::set_look(Side side, const std::string& object, const std::string& name) {
    const auto look = parse_look(name);
    if (!look) refuse_input("look", "", name, "a look, as \"arc, fine\"");
    if (object.empty()) comparison_.set_look_of_all(side, *look);
    for (const ecs::Entity grating : comparison_.gratings())
        if (name_of_object(scene_.world(), grating) == object) comparison_.set_look(grating, side, *look);
}

bool Session::perform(Action action) {
    post::PostSettings& post = picture_->post_settings();
    switch (action) {
        case Action::Lamp:
            scene_.set_sun(!scene_.sun());
            break;
        case Action::NextProbe:
            use_probe(next_in(probe_paths_, probe_path_));
            break;
        case Action::NextView:
            use_view(next_in(views_, view_));
            break;
        case Action::LessExposure:
            post.exposure_stops -= kExposureStep;
            break;
        case Action::MoreExposure:
            post.exposure_stops += kExposureStep;
            break;
        case Action::Bloom:
            toggle(post.bloom);
            break;
        case Action::Vignette:
            toggle(post.vignette, {.vertical_fov = kFieldOfView, .strength = 0.5F});
            break;
        case Action::AutoExposure:
            toggle(post.auto_exposure);
            break;
        case Action::Dither:
            toggle(post.dither);
            break;
        case Action::DepthOfField:
            toggle(post.depth_of_field, {.focus_m = options_.focus_m});
            break;
        case Action::Grain:
            toggle(post.grain);
            break;
        case Action::Glare:
            if (sheets_.empty())
                messages_.say("nothing to look through: start with --glare FILE");
            else
                look_through((sheet_ + 1) % (sheets_.size() + 1));
            break;
        case Action::Reload:
            reload_shaders();
            look_through(sheet_);
            assets_.reload_all();
            break;
        case Action::Screenshot:
        case Action::LinearScreenshot:
            screenshots_.push_back(action);
            break;
        default:
            return false;
    }
    return true;
}

void Session::use_probe(const std::filesystem::path& path) {
    probe_ = assets_.probe(path);
    probe_path_ = path;
    show_probe();
}

void Session::show_probe() {
    picture_->set_probe(*probe_);
    scene_.show_floor(!probe_->dome);
    probe_version_ = probe_.version();
    ++probe_changes_;
}

void Session::set_budget(double gratings_ms) {
    ecs::World& world = scene_.world();
    if (world.alive(budget_)) world.destroy(budget_);
    told_rungs_.clear();
    if (plays_back_)
        for (const ecs::Entity grating : comparison_.gratings()) world.add(grating, diffraction::RecordedRung{});
    if (gratings_ms <= 0.0) return;
    budget_ = world.create();
    world.add(budget_, diffraction::FrameBudget{gratings_ms});
}

std::vector<PlayEvent> Session::take_chosen_rungs() {
    std::vector<PlayEvent> events;
    const std::vector<ecs::Entity> gratings = comparison_.gratings();
    told_rungs_.resize(gratings.size());
    for (std::size_t i = 0; i < gratings.size(); ++i) {
        const auto* drawn = scene_.world().find<diffraction::DrawnRung>(gratings[i]);
        if (drawn == nullptr || drawn->wanted == told_rungs_[i].value_or(drawn->ladder->size() - 1)) continue;
        told_rungs_[i] = drawn->wanted;
        events.emplace_back(SettingEvent{Setting::Rung, static_cast<double>(drawn->wanted), std::to_string(i)});
    }
    return events;
}

void Session::end_playback() {
    plays_back_ = false;
    for (const ecs::Entity grating : comparison_.gratings()) scene_.world().remove<diffraction::RecordedRung>(grating);
}

void Session::use_view(const std::string& view) {
    picture_->set_view(config_, view);
    view_ = view;
    log_info("view {}", view_);
}

void Session::look_through(std::size_t sheet) {
    std::optional<post::GlareSettings> glare;
    if (sheet > 0) glare = glare_of(sheets_[sheet - 1], scene_, picture_->xyz_to_working());
    picture_->post_settings().glare = std::move(glare);
    sheet_ = sheet;
    if (sheet > 0) messages_.say(sheets_[sheet - 1].name + ": looked through");
}

void Session::reload_shaders() {
    shader_failure_.clear();
    try {
        picture_->reload_shaders(options_.shader_folder);
        log_info("shaders reloaded from {}", options_.shader_folder.string());
    } catch (const Error& error) {
        shader_failure_ = error.what();
        log_error("{}", shader_failure_);
    }
}

void Session::follow_files() {
    if (assets_.poll()) refresh_scene();
    if (probe_version_ != probe_.version()) show_probe();
    if (++frames_followed_ % kFramesBetweenShaderChecks == 0 && shaders_.changed()) reload_shaders();
}

void Session::refresh_scene() {
    play_.move_to_rest_pose();
    const bool meshes_changed = scene_.refresh();
    scene_.show_floor(!probe_->dome);
    if (meshes_changed)
        play_.set_toys(scene_.toys());
    else
        play_.update_nodes();
}

void Session::draw(float seconds) {
    if (const std::string why = failure(); why != shown_failure_) {
        shown_failure_ = why;
        if (!why.empty()) messages_.add_logged(why, true);
    }
    draw_from(play_.camera(), seconds);
    for (const Action action : std::exchange(screenshots_, {}))
        messages_.attempt([&] { write_screenshot(action == Action::LinearScreenshot); });
}

void Session::draw_from(const scene::Camera& camera, float seconds) {
    scene::update_world_matrices(scene_.world());
    comparison_.update();
    picture_->draw(scene_.world(), camera, seconds);
}

void Session::write_screenshot(bool linear) {
    const std::filesystem::path path = app::unused_file(options_.output_folder, "screenshot", linear ? ".exr" : ".png");
    if (linear)
        view::write_linear_capture(picture_->linear(), path);
    else
        view::write_display_capture(picture_->encoded(), path);
    messages_.say(path.string() + ": the picture");
}

std::string Session::failure() const {
    if (!shader_failure_.empty()) return shader_failure_;
    if (const auto failures = assets_.failures(); !failures.empty()) return failures.front();
    return scene_.failures().empty() ? std::string() : scene_.failures().front();
}

std::string scene_name(const Options& options) {
    const auto& file = options.scene ? options.scene : options.mesh;
    return file ? valid_utf8(file->filename().string()) : "disc";
}

std::optional<Recording> recording_for(const Options& options) {
    if (!options.play) return std::nullopt;
    Recording recording = load_recording(*options.play);
    // A glTF file and the .scene cooked from it count as the same scene.
    const auto stem = [](const std::string& name) { return std::filesystem::path(name).stem(); };
    if (const std::string shown = scene_name(options); stem(recording.head.scene) != stem(shown))
        refuse_input(options.play->string(), "line 1",
                     fmt::format("a recording with the scene {}", recording.head.scene),
                     fmt::format("one with {}", shown), "name that scene with --scene, --mesh or --disc");
    return recording;
}

void log_state(const Play& play) {
    log_info("played {} steps, state {}", play.steps(), play.fingerprint());
}

}  // namespace rowland::demo
