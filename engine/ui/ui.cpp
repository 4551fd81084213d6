#include "engine/ui/ui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>

#include "engine/core/check.h"
#include "engine/ui/feed_input.h"
#include "engine/ui/style.h"

namespace rowland::ui {

namespace {

/// ImGui divides by the time between frames.
constexpr double kShortestFrame_s = 1e-4;

}  // namespace

struct Ui::State {
    ImGuiContext* context = nullptr;
    UiOptions options;
    InputFeed feed;
    bool in_frame = false;
    bool scale_changed = false;
    bool has_drawn = false;
};

Ui::Ui(const UiOptions& options) : state_(std::make_unique<State>()) {
    state_->options = options;
    state_->context = ImGui::CreateContext();
    ImGui::SetCurrentContext(state_->context);
    ImGuiIO& io = ImGui::GetIO();
    // ImGui stores no layout: programs place their windows themselves.
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendPlatformName = "rowland";
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ConfigInputTextCursorBlink = false;  // a program may draw only when something changes
    map_keys(io);
    set_scale(options.scale);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Ui::~Ui() {
    ImGui::SetCurrentContext(state_->context);
    if (state_->in_frame) ImGui::EndFrame();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(state_->context);
}

void Ui::set_scale(float scale) {
    state_->options.scale = std::clamp(scale, kSmallestScale, kLargestScale);
    state_->scale_changed = true;
}

float Ui::scale() const {
    return state_->options.scale;
}

void Ui::begin_frame(const platform::InputState& input, const UiFrame& frame) {
    ImGui::SetCurrentContext(state_->context);
    if (state_->in_frame) ImGui::EndFrame();
    ImGuiIO& io = ImGui::GetIO();
    if (state_->scale_changed) {
        state_->scale_changed = false;
        ImGui::GetStyle() = make_style(state_->options.scale);
        load_font(io, state_->options.scale);
        // Not all of its objects: ImGui 1.86 would take its new, empty buffers for as large as the old.
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        if (state_->has_drawn) ImGui_ImplOpenGL3_CreateFontsTexture();  // else NewFrame makes it
    }
    const glm::vec2 size(frame.size);
    io.DisplaySize = {size.x, size.y};
    if (frame.size.x > 0 && frame.size.y > 0)
        io.DisplayFramebufferScale = {static_cast<float>(frame.framebuffer_size.x) / size.x,
                                      static_cast<float>(frame.framebuffer_size.y) / size.y};
    io.DeltaTime = static_cast<float>(std::max(frame.seconds, kShortestFrame_s));
    state_->feed.feed(input, io);
    ImGui_ImplOpenGL3_NewFrame();
    state_->has_drawn = true;
    ImGui::NewFrame();
    state_->in_frame = true;
}

bool Ui::wants_mouse() const {
    ImGui::SetCurrentContext(state_->context);
    return ImGui::GetIO().WantCaptureMouse;
}

bool Ui::wants_keyboard() const {
    ImGui::SetCurrentContext(state_->context);
    const ImGuiIO& io = ImGui::GetIO();
    // A window keeps ImGui's own wish for keys after a click into it; ours ends when nothing is highlighted or typed.
    return io.WantTextInput || io.NavVisible;
}

bool Ui::wants_text() const {
    ImGui::SetCurrentContext(state_->context);
    return ImGui::GetIO().WantTextInput;
}

void Ui::render() {
    ROWLAND_CHECK(state_->in_frame, "a user interface is drawn once for each frame that was begun");
    ImGui::SetCurrentContext(state_->context);
    state_->in_frame = false;
    ImGui::Render();
    // The backend leaves all state as it was, at the price of 50 calls: not for nothing.
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
