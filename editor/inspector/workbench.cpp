#include "editor/inspector/workbench.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace rowland::inspector {

namespace {

constexpr std::pair<const char*, const char*> kPreview[] = {
    {"Drag", "orbit"},
    {"Drag the lamp's handle", "move the lamp"},
    {"Drag the line of A/B", "show more or less of the saved version"},
    {"Wheel", "zoom"},
    {"Click", "pick the point for the physics panes"},
};
constexpr std::pair<const char*, const char*> kFields[] = {
    {"Drag a number", "change it"},
    {"Ctrl+click a number", "type it"},
    {"Hover", "meaning, range and source of the formula"},
    {"Tab, arrows", "move through all controls"},
    {"Space, Enter", "use a control"},
    {"Ctrl+Tab", "the next panel"},
};

void help_heading(const char* name) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
}

void help_row(const char* keys, const char* what) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(keys);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", what);
}

constexpr ImGuiWindowFlags kTile = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;

bool begin_tile(const char* name, const ImVec2& corner, const ImVec2& size, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos(corner);
    ImGui::SetNextWindowSize(size);
    return ImGui::Begin(name, nullptr, kTile | more);
}

/// Runs the enabled commands whose keys were pressed in this frame.
void run_pressed(std::span<const Command> commands, const platform::InputState& input) {
    using platform::Key;
    const bool control = input.key(Key::LeftControl).down || input.key(Key::RightControl).down;
    const bool shift = input.key(Key::LeftShift).down || input.key(Key::RightShift).down;
    for (const Command& command : commands)
        if (command.enabled && command.key && input.key(*command.key).pressed &&
            control == command.keys.starts_with("Ctrl+") && shift == (command.keys.find("Shift+") != std::string::npos))
            command.run();
}

void draw_menu_bar(std::span<const Command> commands, ControlMap& controls) {
    if (!ImGui::BeginMainMenuBar()) return;
    for (auto menu = commands.begin(); menu != commands.end();) {
        const auto end =
            std::find_if(menu, commands.end(), [&](const Command& other) { return other.menu != menu->menu; });
        if (!menu->menu.empty() && ImGui::BeginMenu(menu->menu.c_str())) {
            for (const Command& command : std::span(menu, end)) {
                const std::string& title = command.title.empty() ? command.name : command.title;
                if (!command.run) {
                    title.empty() ? ImGui::Separator() : ImGui::TextDisabled("%s", title.c_str());
                    continue;
                }
                if (ImGui::MenuItem(title.c_str(), command.keys.c_str(), command.checked, command.enabled))
                    command.run();
                controls.mark("menu " + command.name);
            }
            ImGui::EndMenu();
        } else if (!menu->menu.empty()) {
            controls.mark("menu " + menu->menu);
        }
        menu = end;
    }
    ImGui::EndMainMenuBar();
}

/// A window that lists the mouse and keys of the preview, of the fields, and of each menu.
void draw_help(std::span<const Command> commands, bool& open, ControlMap& controls) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x / 2.0F, screen.y / 2.0F}, ImGuiCond_Appearing, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(34.0F * font, screen.x), std::min(36.0F * font, screen.y - 4.0F * font)},
                             ImGuiCond_Appearing);
    if (ImGui::Begin("Keys", &open, ImGuiWindowFlags_NoSavedSettings) && ImGui::BeginTable("keys", 2)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 13.0F * font);
        ImGui::TableSetupColumn("what");
        help_heading("Preview");
        for (const auto& [keys, what] : kPreview) help_row(keys, what);
        help_heading("Fields");
        for (const auto& [keys, what] : kFields) help_row(keys, what);
        std::string menu;
        for (const Command& command : commands) {
            if (command.menu.empty() || command.keys.empty()) continue;
            if (menu != command.menu) help_heading((menu = command.menu).c_str());
            help_row(command.keys.c_str(), command.name.c_str());
        }
        ImGui::EndTable();
    }
    controls.note("help", "open");
    ImGui::End();
}

}  // namespace

void Workbench::draw(const platform::InputState& input, bool keys_are_ours, const WorkbenchFrame& frame) {
    const std::vector<Command> present = commands();
    film_.update(session_.opened);
    physics_.update(session_.opened);
    if (keys_are_ours) run_pressed(present, input);
    draw_menu_bar(present, controls_);
    draw_tiles(input, frame);
    if (help_) draw_help(present, help_, controls_);
    const float font = ImGui::GetFontSize();
    if (frame.in_window)
        messages_.draw(session_.messages.all(), frame.size.x - 0.5F * font, frame.size.y - 2.4F * font,
                       std::min(30.0F * font, frame.size.x - font));
    controls_.note("unread", std::to_string(messages_.shown()));
    dialogs_.draw(controls_);
    note_facts();
    controls_.end_frame();
}

void Workbench::note_facts() {
    const Document& document = session_.opened.document();
    const bool dirty = session_.foil ? session_.foil->recipe().dirty() : document.dirty();
    controls_.note("document", session_.document_name() + (dirty ? " *" : ""));
    controls_.note("refused", document.refusal() ? document.refusal()->message : "no");
    controls_.note("material", document.json().dump());
    controls_.note("shape is", preview_shape_name(session_.view.shape()));
    controls_.note("busy", session_.busy() ? "yes" : "no");
    controls_.note("light", session_.light.current() ? session_.light.current()->path.filename().string() : "none");
    if (!session_.messages.all().empty()) controls_.note("message", session_.messages.all().back().text);
}

void Workbench::ask_artwork() {
    dialogs_.ask_picture("The artwork of the card: a PNG or JPEG.", [this](const std::filesystem::path& path) {
        dialogs_.ask_unsaved([this, path] {
            session_.make_foil(path);
            remember(layout_, path);
        });
    });
}

void Workbench::ask_film(FilmSettings settings) {
    dialogs_.ask_file(
        FileKind::Films, "An animated picture (.webp).", session_.foil->recipe().suggested(".webp"),
        [this, settings](const std::filesystem::path& path) mutable {
            if (!session_.foil || !session_.view.ready()) return;
            settings.path = path;
            session_.foil->begin_film(config_, settings, session_.view.card_inputs({1, 1}, preview_.camera()));
        });
}

FoilActions Workbench::foil_actions() {
    return {.choose_picture =
                [this](const Field& field) {
                    dialogs_.ask_picture(field.label + ": a PNG or JPEG.",
                                         [this, &field](const std::filesystem::path& path) {
                                             if (session_.foil) session_.foil->use_picture(field, path);
                                         });
                },
            .save_card =
                [this] {
                    dialogs_.ask_file(FileKind::Models, "The card, a binary glTF file (.glb).",
                                      session_.foil->recipe().suggested(".glb"),
                                      [this](const std::filesystem::path& path) {
                                          if (session_.foil) session_.foil->save_card(path);
                                      });
                },
            .save_film = [this](FilmSettings settings) { ask_film(std::move(settings)); }};
}

std::vector<Command> Workbench::file_commands() {
    using platform::Key;
    Document& document = session_.opened.document();
    FoilStudio* const foil = session_.foil.get();
    std::vector<Command> result = {
        {"File", "New foil card…", "Ctrl+N", Key::N, [this] { ask_artwork(); }},
        {"File", "Open…", "Ctrl+O", Key::O, [this] { dialogs_.ask_open(); }},
        {"File", "Save", "Ctrl+S", Key::S, [this] { dialogs_.save(); }},
        {"File", "Save as…", "Ctrl+Shift+S", Key::S, [this] { dialogs_.ask_save_as(); }},
    };
    if (foil != nullptr) {
        result.push_back(
            {"File", "Close foil card", {}, {}, [this] { dialogs_.ask_unsaved([this] { session_.close_foil(); }); }});
    } else {
        const std::vector<Command> of_documents = {
            {"File",
             "Close scene",
             {},
             {},
             [this] { dialogs_.ask_unsaved([this] { session_.opened.close_scene(); }); },
             document.is_scene()},
            {"File",
             "Open in the demo",
             {},
             {},
             [this] { session_.open_in_demo(); },
             document.is_scene() || document.has_grating()},
            {"File", "Capture the boxes' light", "F9", Key::F9, [this] { session_.capture_probes(); },
             session_.boxes() > 0 && !session_.capturing()},
        };
        result.insert(result.end(), of_documents.begin(), of_documents.end());
    }
    const auto undo = [this, foil] { foil ? foil->recipe().undo() : session_.opened.document().undo(); };
    const auto redo = [this, foil] { foil ? foil->recipe().redo() : session_.opened.document().redo(); };
    const bool can_undo = foil ? foil->recipe().can_undo() : document.can_undo();
    const bool can_redo = foil ? foil->recipe().can_redo() : document.can_redo();
    const std::vector<Command> last = {
        {"File", ""},
        {"File", "Quit", "Ctrl+Q", Key::Q, [this] { ask_to_close(); }},
        {"Edit", "Undo", "Ctrl+Z", Key::Z, undo, can_undo},
        {"Edit", "Redo", "Ctrl+Shift+Z", Key::Z, redo, can_redo},
        {"", "Redo", "Ctrl+Y", Key::Y, redo, can_redo},
    };
    result.insert(result.end(), last.begin(), last.end());
    return result;
}

std::vector<Command> Workbench::commands() {
    using platform::Key;
    const auto scale_by = [this](float step) {
        return [this, step] { layout_.scale = std::clamp(layout_.scale + step, 0.5F, 4.0F); };
    };
    std::vector<Command> result = file_commands();
    const char* category = "";
    for (const Preset& preset : OpenDocument::presets()) {
        if (std::string_view(std::exchange(category, preset.category)) != preset.category)
            result.push_back({.menu = "Presets", .name = "", .title = preset.category});
        const auto run = [this, file = preset.file] {
            const auto open = [this, file] { session_.open_preset(file); };
            !session_.foil&& session_.opened.document().is_scene() ? open() : dialogs_.ask_unsaved(open);
        };
        result.push_back({.menu = "Presets", .name = preset.file, .run = run, .title = preset.name});
    }
    for (std::size_t i = 0; i < kPreviewShapes.size(); ++i) {
        const PreviewShape shape = kPreviewShapes[i];
        result.push_back({"View", preview_shape_name(shape), fmt::format("Ctrl+{}", i + 1),
                          static_cast<Key>(static_cast<std::size_t>(Key::Digit1) + i),
                          [this, shape] { session_.view.choose_shape(shape); },
                          !session_.foil && (shape != PreviewShape::Scene || session_.opened.scene() != nullptr),
                          shape == session_.view.shape()});
    }
    const std::vector<Command> view_and_help = {
        {"View", ""},
        {"View", "Compare with saved", "F6", Key::F6, [this] { preview_.comparing = !preview_.comparing; },
         !session_.foil && session_.opened.surface(true) != nullptr, preview_.comparing},
        {"View", "Show grooves", "G", Key::G, [this] { session_.view.shows_grooves = !session_.view.shows_grooves; },
         true, session_.view.shows_grooves},
        {"View", "Frame the selection", "F", Key::F, [this] { preview_.frame(session_.view); }},
        {"View", "Screenshot", "F12", Key::F12, [this] { screenshot_ = true; }},
        {"View", "Larger text", "Ctrl+=", Key::Equal, scale_by(0.1F)},
        {"View", "Smaller text", "Ctrl+-", Key::Minus, scale_by(-0.1F)},
        {"Help", "Keys", "F1", Key::F1, [this] { help_ = !help_; }, true, help_},
        {"", "Larger text", "Ctrl+Shift+=", Key::Equal, scale_by(0.1F)},
    };
    result.insert(result.end(), view_and_help.begin(), view_and_help.end());
    return result;
}

TileSizes tile_sizes(const Layout& layout, glm::vec2 size, float font) {
    const float preview_width = std::min(28.0F * font, 0.45F * size.x);
    const float preview_height = std::min(20.0F * font, 0.7F * size.y);
    const float sides =
        std::min(1.0F, (size.x - preview_width) / ((layout.material_width + layout.physics_width) * font));
    return {.left = sides * layout.material_width * font,
            .right = sides * layout.physics_width * font,
            .below = std::min(layout.price_height * font, size.y - preview_height)};
}

void Workbench::splitter(const char* name, const ImVec2& corner, const ImVec2& size, float& value, float shown,
                         float sign) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    begin_tile(name, corner, size,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton(name, size);
    controls_.mark(name);
    if (ImGui::IsItemActive()) {
        constexpr float kLeast = 4.0F;
        const ImVec2 delta = ImGui::GetIO().MouseDelta;
        const float moved = sign * (size.y > size.x ? delta.x : delta.y);
        if (moved != 0.0F) value = std::max(kLeast, (shown + moved) / ImGui::GetFontSize());
    }
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y},
                                                  IM_COL32(66, 140, 217, 160));
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Workbench::draw_tiles(const platform::InputState& input, const WorkbenchFrame& frame) {
    const float top = ImGui::GetFrameHeight();
    const float status = 1.9F * ImGui::GetFontSize();
    const float height = frame.size.y - top - status;
    session_.foil ? draw_foil_tiles(input, frame, height) : draw_document_tiles(input, frame, height);
    draw_status(top + height, frame.size.x, status, frame.frame_ms);
    // A window takes the focus when it appears. The fields shall have it, so that the first Tab goes to the first one.
    if (!std::exchange(focused_, true)) ImGui::SetWindowFocus(session_.foil ? "Foil card" : "Material");
}

void Workbench::draw_foil_tiles(const platform::InputState& input, const WorkbenchFrame& frame, float height) {
    const float gap = 0.35F * ImGui::GetFontSize();
    const float top = ImGui::GetFrameHeight();
    const TileSizes sizes = tile_sizes(layout_, {frame.size.x, height}, ImGui::GetFontSize());
    const float middle = frame.size.x - sizes.left - sizes.right - 2.0F * gap;
    FoilStudio& foil = *session_.foil;
    foil.film_step();
    foil.advance(frame.seconds);
    session_.view.card = foil.card();
    if (begin_tile("Foil card", {0.0F, top}, {sizes.left, height})) foil_.draw(foil, foil_actions(), controls_);
    ImGui::End();
    // With the scrollbar always there the columns do not change from one frame to the next.
    if (begin_tile("Types of foil", {frame.size.x - sizes.right, top}, {sizes.right, height},
                   ImGuiWindowFlags_AlwaysVerticalScrollbar))
        draw_foil_wall(foil, controls_);
    ImGui::End();
    if (begin_tile("Card", {sizes.left + gap, top}, {middle, height},
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse))
        preview_.draw(foil, session_.light, session_.view, input, frame.pixels_per_unit, frame.seconds, controls_);
    ImGui::End();
    splitter("left splitter", {sizes.left, top}, {gap, height}, layout_.material_width, sizes.left, 1.0F);
    splitter("right splitter", {frame.size.x - sizes.right - gap, top}, {gap, height}, layout_.physics_width,
             sizes.right, -1.0F);
}

void Workbench::draw_document_tiles(const platform::InputState& input, const WorkbenchFrame& frame, float height) {
    const float font = ImGui::GetFontSize();
    const float gap = 0.35F * font;
    const float top = ImGui::GetFrameHeight();
    const auto [left, right, below] = tile_sizes(layout_, {frame.size.x, height}, font);
    const float middle = frame.size.x - left - right - 2.0F * gap;

    if (begin_tile("Material", {0.0F, top}, {left, height})) {
        scene_.draw(session_.opened, session_.view, controls_);
        if (const SceneObject* scene = session_.opened.scene())
            boxes_.draw(session_.opened.document(), *scene, controls_);
        if (session_.opened.document().accepted()) material_.draw(session_.opened.document(), controls_);
    }
    ImGui::End();
    const auto draw_if_any = [this](const auto& draw) {
        if (session_.opened.document().accepted()) return draw();
        ImGui::PushTextWrapPos();
        ImGui::TextDisabled("The chosen material has no grating or film.");
        ImGui::PopTextWrapPos();
    };
    if (begin_tile("Physics", {frame.size.x - right, top}, {right, height}))
        draw_if_any([&] {
            session_.opened.document().has_film()
                ? film_.draw(session_.view, controls_)
                : physics_.draw(session_.opened, session_.view, session_.measurement, controls_);
        });
    ImGui::End();
    if (begin_tile("Price", {left + gap, top + height - below}, {middle, below}))
        draw_if_any(
            [&] { price_.draw(session_.measurement, session_.opened, session_.view, frame.frame_ms, controls_); });
    ImGui::End();
    if (begin_tile("Preview", {left + gap, top}, {middle, height - below - gap},
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse)) {
        preview_.draw(session_.opened, session_.light, session_.view, input, frame.pixels_per_unit, frame.seconds,
                      controls_);
        const SceneObject* scene = session_.opened.scene();
        if (const auto& picture = preview_.picture();
            picture && scene != nullptr && session_.view.shape() == PreviewShape::Scene && session_.view.ready())
            boxes_.draw_edges(session_.opened.document(), *scene, session_.view.preview(), picture->first,
                              picture->second);
    }
    ImGui::End();
    splitter("left splitter", {left, top}, {gap, height}, layout_.material_width, left, 1.0F);
    splitter("right splitter", {frame.size.x - right - gap, top}, {gap, height}, layout_.physics_width, right, -1.0F);
    splitter("lower splitter", {left + gap, top + height - below - gap}, {middle, gap}, layout_.price_height, below,
             -1.0F);
}

void Workbench::draw_status(float top, float width, float height, double frame_ms) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    begin_tile("##status", {0.0F, top}, {width, height},
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollbar);
    const Document& document = session_.opened.document();
    const bool dirty = session_.foil ? session_.foil->recipe().dirty() : document.dirty();
    ImGui::TextUnformatted((session_.document_name() + (dirty ? " •" : "")).c_str());
    if (dirty && ImGui::IsItemHovered()) ImGui::SetTooltip("Not saved");
    if (frame_ms > 0.0) {
        ImGui::SameLine();
        ImGui::TextDisabled("%.1f ms", frame_ms);
    }
    if (!session_.messages.all().empty()) {
        const Message& last = session_.messages.all().back();
        ImGui::SameLine();
        if (last.failure)
            ImGui::TextColored({0.95F, 0.60F, 0.15F, 1.0F}, "%s", last.text.c_str());
        else
            ImGui::TextDisabled("%s", last.text.c_str());
        if (ImGui::IsItemHovered() && last.text.size() > 60) {
            ImGui::BeginTooltip();
            ImGui::PushTextWrapPos(40.0F * ImGui::GetFontSize());
            ImGui::TextUnformatted(last.text.c_str());
            ImGui::PopTextWrapPos();
            ImGui::EndTooltip();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace rowland::inspector
