#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "engine/gpu/framebuffer.h"
#include "engine/platform/input.h"

struct ImGuiContext;
struct ImGuiIO;

namespace rowland::ui {

/// Passes a frame's keys, text and mouse to ImGui, which takes one state of each per frame. At low frame rates no click
/// or drag is lost: a button pressed and released within a frame is down in it, at the position of the press; a drag
/// within it moves in the next frame and is released in the one after.
class InputFeed {
 public:
    void feed(const platform::InputState& input, ImGuiIO& io);

 private:
    void feed_mouse(const platform::InputState& input, ImGuiIO& io);

    std::array<bool, 3> down_{};  ///< mouse buttons, as last passed
    glm::dvec2 seen_{0.0};        ///< mouse position, as last passed
};

inline constexpr float kSmallestScale = 0.5F;
inline constexpr float kLargestScale = 4.0F;

struct UiFrame {
    glm::ivec2 size{0};              ///< screen coordinates, which the mouse has too (platform::Window::size())
    glm::ivec2 framebuffer_size{0};  ///< pixels
    double seconds = 0.0;            ///< since the last frame
};

/// Dear ImGui on our own input and context, so that recordings play back and tests need no window. The context must be
/// current from construction to destruction. Between begin_frame() and draw() any ImGui:: function may be called.
///
///     window.poll(input);
///     ui.begin_frame(input, {window.size(), window.framebuffer_size(), seconds});
///     if (!ui.wants_mouse()) ...         // the scene takes the mouse
///     if (!ui.wants_keyboard()) ...      // and the keys
///     if (ImGui::Begin("Panel") && ImGui::Button("Press")) ...
///     ImGui::End();
///     ...                                // draw the scene
///     ui.draw(target);                   // over it; or draw_in_window()
class Ui {
 public:
    /// `scale`: of text and controls, kSmallestScale to kLargestScale.
    explicit Ui(float scale = 1.0F);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// `input` as of this frame. Ends a frame that was begun and never drawn.
    void begin_frame(const platform::InputState& input, const UiFrame& frame);

    /// Whether this frame's mouse is over, or was pressed on, something of the user interface.
    bool wants_mouse() const;
    /// Whether keys move through controls or are typed into one. ImGui never uses function keys.
    bool wants_keyboard() const;
    /// Whether a text field has the keyboard, so that no key is for the program.
    bool wants_text() const;

    /// Draws the frame over what is in `target`, of the frame's framebuffer size, and leaves GL's state as it was
    /// but for the bound framebuffer.
    void draw(const gpu::Framebuffer& target);
    /// The same into the window's own framebuffer.
    void draw_in_window();

    /// Takes effect with the next frame; clamped to its range.
    void set_scale(float scale);
    float scale() const { return scale_; }

 private:
    void render();

    ImGuiContext* context_;
    float scale_ = 1.0F;
    bool scale_changed_ = false;
    InputFeed feed_;
    bool in_frame_ = false;
    bool has_drawn_ = false;
};

}  // namespace rowland::ui
