#include "engine/ui/ui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/core/program.h"

namespace rowland::ui {

namespace {

using platform::Key;
using platform::MouseButton;

struct EditingKey {
    int imgui;
    Key key;
};

constexpr std::array kEditingKeys{
    EditingKey{ImGuiKey_Tab, Key::Tab},
    EditingKey{ImGuiKey_LeftArrow, Key::Left},
    EditingKey{ImGuiKey_RightArrow, Key::Right},
    EditingKey{ImGuiKey_UpArrow, Key::Up},
    EditingKey{ImGuiKey_DownArrow, Key::Down},
    EditingKey{ImGuiKey_PageUp, Key::PageUp},
    EditingKey{ImGuiKey_PageDown, Key::PageDown},
    EditingKey{ImGuiKey_Home, Key::Home},
    EditingKey{ImGuiKey_End, Key::End},
    EditingKey{ImGuiKey_Insert, Key::Insert},
    EditingKey{ImGuiKey_Delete, Key::Delete},
    EditingKey{ImGuiKey_Backspace, Key::Backspace},
    EditingKey{ImGuiKey_Space, Key::Space},
    EditingKey{ImGuiKey_Enter, Key::Enter},
    EditingKey{ImGuiKey_Escape, Key::Escape},
    EditingKey{ImGuiKey_A, Key::A},
    EditingKey{ImGuiKey_C, Key::C},
    EditingKey{ImGuiKey_V, Key::V},
    EditingKey{ImGuiKey_X, Key::X},
    EditingKey{ImGuiKey_Y, Key::Y},
    EditingKey{ImGuiKey_Z, Key::Z},
};

/// In the order of ImGui's mouse buttons.
constexpr std::array kMouseButtons{MouseButton::Left, MouseButton::Right, MouseButton::Middle};

bool was_down(const platform::ButtonState& button) {
    return button.down || button.pressed;
}

bool either_down(const platform::InputState& input, Key left, Key right) {
    return input.key(left).down || input.key(right).down;
}

/// Tells ImGui which keys edit text and move through controls. ImGui then uses our key numbers.
void map_keys(ImGuiIO& io) {
    for (const EditingKey& editing : kEditingKeys) io.KeyMap[editing.imgui] = static_cast<int>(editing.key);
}

}  // namespace

void InputFeed::feed(const platform::InputState& input, ImGuiIO& io) {
    for (int key = 0; key < static_cast<int>(Key::Count); ++key)
        io.KeysDown[key] = was_down(input.key(static_cast<Key>(key)));
    io.KeyCtrl = either_down(input, Key::LeftControl, Key::RightControl);
    io.KeyShift = either_down(input, Key::LeftShift, Key::RightShift);
    io.KeyAlt = either_down(input, Key::LeftAlt, Key::RightAlt);
    for (const char32_t c : input.typed()) io.AddInputCharacter(static_cast<unsigned>(c));
    feed_mouse(input, io);
    io.MouseWheelH += static_cast<float>(input.scroll().x);
    io.MouseWheel += static_cast<float>(input.scroll().y);
}

void InputFeed::feed_mouse(const platform::InputState& input, ImGuiIO& io) {
    glm::dvec2 position = input.mouse_position();
    for (const MouseButton button : kMouseButtons)
        if (input.mouse_button(button).pressed) position = input.press_position(button);
    for (std::size_t i = 0; i < kMouseButtons.size(); ++i) {
        const bool moves_first = down_[i] && position != seen_;
        down_[i] = was_down(input.mouse_button(kMouseButtons[i])) || moves_first;
        io.MouseDown[i] = down_[i];
    }
    seen_ = position;
    // ImGui takes this position for "no mouse".
    constexpr float kNowhere = -std::numeric_limits<float>::max();
    const glm::vec2 shown(position);
    io.MousePos = input.focused() ? ImVec2(shown.x, shown.y) : ImVec2(kNowhere, kNowhere);
}

namespace {

/// The shortest time between frames that ImGui is given, since it divides by it.
constexpr double kShortestFrame_s = 1e-4;
constexpr float kFontSize = 15.0F;         ///< pixels at scale 1
constexpr float kBuiltInFontSize = 13.0F;  ///< of ImGui's own font

/// First and last of each range, then 0: Latin, Greek, general punctuation, super- and subscripts, arrows, mathematics,
/// geometric shapes.
constexpr std::array<ImWchar, 15> kGlyphs = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2044, 0x2070, 0x209F,
                                             0x2190, 0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF, 0};

ImVec4 grey(float value, float alpha = 1.0F) {
    return {value, value, value, alpha};
}

/// A blue that is distinguishable with all kinds of colour vision.
ImVec4 accent(float alpha) {
    return {0.26F, 0.55F, 0.85F, alpha};
}

void set_colours(ImGuiStyle& style) {
    ImGui::StyleColorsDark(&style);
    const auto set = [&style](ImGuiCol which, const ImVec4& colour) { style.Colors[which] = colour; };
    set(ImGuiCol_Text, grey(0.93F));
    set(ImGuiCol_TextDisabled, grey(0.60F));
    set(ImGuiCol_WindowBg, grey(0.08F, 0.86F));
    set(ImGuiCol_PopupBg, grey(0.10F, 0.96F));
    set(ImGuiCol_Border, grey(1.0F, 0.10F));
    set(ImGuiCol_TitleBg, grey(0.12F, 0.92F));
    set(ImGuiCol_TitleBgActive, grey(0.18F, 0.96F));
    set(ImGuiCol_TitleBgCollapsed, grey(0.12F, 0.70F));
    set(ImGuiCol_FrameBg, grey(1.0F, 0.09F));
    set(ImGuiCol_FrameBgHovered, grey(1.0F, 0.15F));
    set(ImGuiCol_FrameBgActive, grey(1.0F, 0.20F));
    set(ImGuiCol_Button, grey(1.0F, 0.12F));
    set(ImGuiCol_ButtonHovered, accent(0.60F));
    set(ImGuiCol_ButtonActive, accent(0.90F));
    set(ImGuiCol_Header, grey(1.0F, 0.10F));
    set(ImGuiCol_HeaderHovered, accent(0.45F));
    set(ImGuiCol_HeaderActive, accent(0.70F));
    set(ImGuiCol_CheckMark, accent(1.0F));
    set(ImGuiCol_SliderGrab, accent(0.85F));
    set(ImGuiCol_SliderGrabActive, accent(1.0F));
    set(ImGuiCol_PlotLines, accent(1.0F));
    set(ImGuiCol_PlotHistogram, accent(0.85F));
    set(ImGuiCol_NavHighlight, accent(1.0F));
}

/// The style of all our programs: dark and neutral, so that it does not affect the perception of colours beside it.
ImGuiStyle make_style(float scale) {
    ImGuiStyle style;
    set_colours(style);
    style.WindowRounding = 5.0F;
    style.FrameRounding = 3.0F;
    style.GrabRounding = 3.0F;
    style.PopupRounding = 4.0F;
    style.ScrollbarRounding = 4.0F;
    style.WindowPadding = {10.0F, 8.0F};
    style.FramePadding = {6.0F, 3.0F};
    style.ItemSpacing = {7.0F, 4.0F};
    style.ScaleAllSizes(scale);
    return style;
}

/// DejaVu Sans: of the system, or in the folder fonts beside the program's.
std::string font_file() {
    const std::filesystem::path system = ROWLAND_UI_FONT;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(system, ignored)) return system.string();
    return (program_prefix() / "fonts" / system.filename()).string();
}

/// Loads the font at `scale`: DejaVu Sans with Greek letters, arrows and mathematical signs; or ImGui's own, with Latin
/// letters only, if the system does not have it.
void load_font(ImGuiIO& io, float scale) {
    io.Fonts->Clear();
    // Checked first, since ImGui asserts that the file exists.
    std::error_code ignored;
    const std::string file = font_file();
    if (std::filesystem::is_regular_file(file, ignored) &&
        io.Fonts->AddFontFromFileTTF(file.c_str(), std::round(kFontSize * scale), nullptr, kGlyphs.data()) != nullptr)
        return;
    log_warning("{} is missing: text of the user interface has Latin letters only", file);
    ImFontConfig config;
    config.SizePixels = std::round(kBuiltInFontSize * scale);
    io.Fonts->AddFontDefault(&config);
}

}  // namespace

Ui::Ui(float scale) : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    // ImGui stores no layout: programs place their windows themselves.
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendPlatformName = "rowland";
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ConfigInputTextCursorBlink = false;  // a program may draw only when something changes
    map_keys(io);
    set_scale(scale);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Ui::~Ui() {
    ImGui::SetCurrentContext(context_);
    if (in_frame_) ImGui::EndFrame();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context_);
}

void Ui::set_scale(float scale) {
    scale_ = std::clamp(scale, kSmallestScale, kLargestScale);
    scale_changed_ = true;
}

void Ui::begin_frame(const platform::InputState& input, const UiFrame& frame) {
    ImGui::SetCurrentContext(context_);
    if (in_frame_) ImGui::EndFrame();
    ImGuiIO& io = ImGui::GetIO();
    if (scale_changed_) {
        scale_changed_ = false;
        ImGui::GetStyle() = make_style(scale_);
        load_font(io, scale_);
        // Only the font: if all objects were rebuilt, ImGui 1.86 would take the empty buffers to be as large as before.
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        if (has_drawn_) ImGui_ImplOpenGL3_CreateFontsTexture();  // else NewFrame makes it
    }
    const glm::vec2 size(frame.size);
    io.DisplaySize = {size.x, size.y};
    if (frame.size.x > 0 && frame.size.y > 0)
        io.DisplayFramebufferScale = {static_cast<float>(frame.framebuffer_size.x) / size.x,
                                      static_cast<float>(frame.framebuffer_size.y) / size.y};
    io.DeltaTime = static_cast<float>(std::max(frame.seconds, kShortestFrame_s));
    feed_.feed(input, io);
    ImGui_ImplOpenGL3_NewFrame();
    has_drawn_ = true;
    ImGui::NewFrame();
    in_frame_ = true;
}

bool Ui::wants_mouse() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Ui::wants_keyboard() const {
    ImGui::SetCurrentContext(context_);
    const ImGuiIO& io = ImGui::GetIO();
    // Not WantCaptureKeyboard, which stays true after a click into a window when no control is selected.
    return io.WantTextInput || io.NavVisible;
}

bool Ui::wants_text() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantTextInput;
}

void Ui::render() {
    ROWLAND_CHECK(in_frame_, "a user interface is drawn once for each frame that was begun");
    ImGui::SetCurrentContext(context_);
    in_frame_ = false;
    ImGui::Render();
    // Skipped if there is nothing to draw: the backend saves and restores OpenGL's state, which takes 50 calls.
    if (ImDrawData* drawn = ImGui::GetDrawData(); drawn->TotalVtxCount > 0) ImGui_ImplOpenGL3_RenderDrawData(drawn);
}

void Ui::draw(const gpu::Framebuffer& target) {
    target.bind();
    render();
}

void Ui::draw_in_window() {
    gpu::Framebuffer::bind_window();
    render();
}

}  // namespace rowland::ui
