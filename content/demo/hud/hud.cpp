#include "content/demo/hud/hud.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "content/demo/pixel/surface_point.h"
#include "content/demo/play/body.h"
#include "engine/app/drawing_program.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

/// Whether the HUD consumes an event. It consumes no release: a key or button whose press it consumed is up for the
/// play anyway.
bool is_for_hud(const PlayEvent& event, bool wants_mouse, bool wants_keys) {
    const auto* input = std::get_if<platform::InputEvent>(&event);
    if (input == nullptr) return false;
    if (const auto* key = std::get_if<platform::KeyEvent>(input))
        return wants_keys && key->down && (key->key < platform::Key::F1 || key->key > platform::Key::F12);
    if (const auto* button = std::get_if<platform::MouseButtonEvent>(input)) return wants_mouse && button->down;
    return wants_mouse && std::holds_alternative<platform::ScrollEvent>(*input);
}

}  // namespace

Hud::Hud(const Options& options, Session& session, const platform::FrameTimes& frame_times, glm::ivec2 window,
         float scale)
    : options_(options), session_(session), frame_times_(frame_times), ui_(scale), window_(window) {}

std::vector<PlayEvent> Hud::begin_frame(std::vector<PlayEvent> events, const ui::UiFrame& frame) {
    input_.begin_frame();
    for (const PlayEvent& event : events)
        if (const auto* input = std::get_if<platform::InputEvent>(&event)) input_.apply(*input);
    window_ = frame.size;
    ui_.begin_frame(input_, frame);
    const bool wants_mouse = ui_.wants_mouse() && !session_.play().walking();
    std::erase_if(events, [&](const auto& event) { return is_for_hud(event, wants_mouse, ui_.wants_keyboard()); });
    for (PlayEvent& event : std::exchange(events_, {})) events.push_back(std::move(event));
    return events;
}

bool Hud::perform(Action action) {
    switch (action) {
        case Action::Help:
            help_ = !help_;
            break;
        case Action::Hud:
            hints_ = panels_ = !panels_;
            if (!panels_) help_ = times_ = false;
            break;
        case Action::FrameGraph:
            times_ = !times_;
            break;
        case Action::Wipe:
            toggle_wipe();
            break;
        case Action::Reference:
            reference_ = !reference_;
            if (reference_) panel().set(Setting::Wipe, 1.0);
            break;
        case Action::NextLook:
        case Action::NextDetail:
            choose_look(action == Action::NextDetail);
            break;
        case Action::WritePixel:
            write_pixel();
            break;
        default:
            return false;
    }
    return true;
}

Panel Hud::panel() {
    return {options_, session_, events_, reference_};
}

glm::dvec2 Hud::pointer() const {
    return session_.play().walking() ? 0.5 * glm::dvec2(window_) : input_.mouse_position();
}

Side Hud::side_of_pointer() const {
    const Comparison& comparison = session_.comparison();
    const double line = static_cast<double>(comparison.line()) * window_.x;
    return comparison.wiping() && pointer().x > line ? Side::Right : Side::Left;
}

std::optional<Hud::Pointed> Hud::pointed() const {
    if (ui_.wants_mouse() && !session_.play().walking()) return std::nullopt;
    const auto hit = session_.play().hit_at(pointer());
    if (!hit) return std::nullopt;
    const ecs::Entity entity = session_.play().toys().targets[hit->target].entity;
    if (!session_.comparison().is_grating(entity)) return std::nullopt;
    return Pointed{entity, *hit};
}

/// Changes the look, or its detail, of the grating under the cursor, else of all gratings.
void Hud::choose_look(bool detail) {
    Comparison& comparison = session_.comparison();
    const Side side = side_of_pointer();
    const std::vector<ecs::Entity> gratings = comparison.gratings();
    if (gratings.empty()) return;
    const auto under_cursor = pointed();
    const ecs::Entity example = under_cursor ? under_cursor->grating : gratings.front();
    const Look& present = comparison.look(example, side);
    const Look next = detail ? next_detail(present) : next_representation(comparison.subject(example), present);
    const std::string object = under_cursor ? name_of_object(session_.play().world(), example) : std::string();
    panel().set(look_setting(side), look_name(next), object);
    log_info("{}: {}", object.empty() ? "all" : object, look_name(next));
}

/// The first wipe compares the scene's own looks with the paper's method.
void Hud::toggle_wipe() {
    Comparison& comparison = session_.comparison();
    panel().set(Setting::Wipe, comparison.wiping() ? 0.0 : 1.0);
    if (comparison.wiping()) return;
    for (const ecs::Entity grating : comparison.gratings())
        if (!(comparison.look(grating, Side::Left) == comparison.look(grating, Side::Right))) return;
    panel().set(Setting::RightLook, look_name({.representation = "spikes"}));
}

PixelProbe Hud::probe() const {
    return {.path = session_.probe_path(),
            .mapping = options_.probe_mapping,
            .recipes = options_.content_folder / "probes",
            .version = session_.probe_version()};
}

void Hud::show_reference() {
    Comparison& comparison = session_.comparison();
    if (reference_ && comparison.wiping())
        reference_picture_.update(session_.play().world(), comparison, session_.play().camera(),
                                  session_.picture().linear().size(), probe());
    else
        reference_picture_.stop(comparison);
}

std::string Hud::name_of_all(Side side) {
    Comparison& comparison = session_.comparison();
    if (side == Side::Right && reference_) {
        if (!reference_picture_.failure().empty()) return reference_picture_.failure();
        return reference_picture_.begun() ? fmt::format("reference, {:.0f} %", 100.0 * reference_picture_.progress())
               : session_.play().paused()
                   ? std::string("reference, once nothing moves")
                   : "reference: press " + platform::name_of(key_row(Action::Pause).key) + ", it needs a scene at rest";
    }
    std::vector<ecs::Entity> gratings = comparison.gratings();
    const auto is_own = [&](ecs::Entity grating) { return comparison.look(grating, side).own(); };
    const bool all_own = std::ranges::all_of(gratings, is_own);
    if (!all_own) std::erase_if(gratings, is_own);
    std::optional<std::string> common;
    for (const ecs::Entity grating : gratings) {
        const std::string title = comparison.title(grating, side);
        if (common && *common != title) return all_own ? look_name({}) : "several";
        common = title;
    }
    return common.value_or(look_name({}));
}

void Hud::measure_pixel() {
    target_.reset();
    meter_.forget();
    const auto under_cursor = pointed();
    if (!under_cursor) return;
    Comparison& comparison = session_.comparison();
    ecs::World& world = session_.play().world();
    const ecs::Entity grating = under_cursor->grating;
    const Side side = side_of_pointer();
    target_ = PixelTarget{.object = name_of_object(world, grating), .representation = comparison.title(grating, side)};
    if (world.get<diffraction::DiffractionSurface>(grating).grooves) {
        target_->refusal = "not measured: its grooves vary over the surface";
        return;
    }
    const PlacedGrating placed = placed_grating(world, grating).value();
    const auto frame =
        frame_at(placed, under_cursor->hit.triangle, under_cursor->hit.point, session_.play().camera().eye);
    if (!frame) {
        target_->refusal = "seen from behind";
        return;
    }
    PixelQuery query{.cooked = comparison.shown(grating, side)->cooked(),
                     .frame = *frame,
                     .layout = comparison.layout(grating),
                     .window = std::nullopt,
                     .probe = probe()};
    if (options_.light_window != "auto") query.window = math::parse_window(options_.light_window);
    meter_.ask(query);
}

/// Writes the frame, for rowland-trade, and the reading.
void Hud::write_pixel() {
    if (!target_ || !meter_.is_up_to_date()) {
        log_info("no pixel to write: {}", target_ ? "it is being measured" : "point at a grating");
        return;
    }
    const PixelReading& reading = *meter_.reading();
    const std::string name = app::unused_file(options_.output_folder, "pixel", ".json").stem().string();
    try {
        write_file_atomic(options_.output_folder / (name + ".csv"), frames_csv(reading.query.frame));
        write_file_atomic(options_.output_folder / (name + ".json"), reading_json(reading));
        log_info("wrote {}", (options_.output_folder / (name + ".json")).string());
    } catch (const Error& error) {
        log_error("{}", error.what());
    }
}

void Hud::main_window() {
    const ImGuiIO& io = ImGui::GetIO();
    // The panel would cover what a wipe compares: it folds to its title, which a click unfolds.
    const bool wiping = session_.comparison().wiping();
    if (std::exchange(wiped_, wiping) != wiping) ImGui::SetNextWindowCollapsed(wiping);
    const float width = (wiping ? 28.0F : 21.0F) * ImGui::GetFontSize();
    ImGui::SetNextWindowPos({10.0F, 10.0F});
    ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, io.DisplaySize.y - 60.0F});
    const ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
    if (ImGui::Begin("Rowland", nullptr, flags)) {
        const auto section = [&](const char* name, void (*contents)(const Panel&), bool open) {
            if (ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None))
                contents(panel());
        };
        ImGui::PushItemWidth(-5.0F * ImGui::GetFontSize());
        section("Light", light_panel, true);
        section("Picture", picture_panel, false);
        section("Play", play_panel, false);
        section("Gratings", gratings_panel, true);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

void Hud::build() {
    show_reference();
    if (session_.comparison().wiping())
        if (const auto line =
                wipe_handle(session_.comparison().line(), name_of_all(Side::Left), name_of_all(Side::Right)))
            panel().set(Setting::WipeLine, *line);
    if (panels_) {
        measure_pixel();
        meter_.poll();
        main_window();
        // Help covers the pixel window.
        if (!help_ && pixel_window(target_ ? &*target_ : nullptr, meter_, session_.picture().xyz_to_working()))
            write_pixel();
    }
    if (hints_) key_hints();
    session_.picture().time_passes(times_);
    if (times_) frame_window(frame_times_, session_.picture().pass_times().latest(), times_);
    if (help_) help_window(help_);
    const float font = ImGui::GetFontSize();
    const float width = std::min(30.0F * font, static_cast<float>(window_.x) - 20.0F);
    messages_.draw(session_.messages(), 10.0F + width, static_cast<float>(window_.y) - 3.0F * font, width);
}

void Hud::draw_in_window() {
    ui_.draw_in_window();
}

}  // namespace rowland::demo
