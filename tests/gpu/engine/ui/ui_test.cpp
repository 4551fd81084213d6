// The user interface on a context without a window, used through input events.
#include "engine/ui/ui.h"

#include <imgui.h>

#include "engine/gpu/pipeline_state.h"
#include "tests/gpu/gl_test.h"

namespace rowland {
namespace {

using platform::CharEvent;
using platform::Key;
using platform::KeyEvent;
using platform::MouseButton;
using platform::MouseButtonEvent;
using platform::MouseMoveEvent;

constexpr glm::ivec2 kSize{160, 120};
constexpr glm::dvec2 kOnButton{40.0, 40.0};
constexpr glm::dvec2 kBesideWindow{150.0, 110.0};
constexpr ImGuiWindowFlags kBare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove;

/// A window from (10, 10) to (110, 90) with a button that fills it, or a field.
class UiTest : public test::GlTest {
 protected:
    /// One frame: the events, then what `contents` puts into the window.
    template <typename F>
    void frame(const std::vector<platform::InputEvent>& events, F&& contents) {
        input_.begin_frame();
        for (const platform::InputEvent& event : events) input_.apply(event);
        ui_.begin_frame(input_, {.size = kSize, .framebuffer_size = kSize, .seconds = 1.0 / 60.0});
        ImGui::SetNextWindowPos({10.0F, 10.0F});
        ImGui::SetNextWindowSize({100.0F, 80.0F});
        ImGui::Begin("panel", nullptr, kBare);
        contents();
        ImGui::End();
        target_.clear({0.0F, 0.0F, 0.0F, 1.0F});
        ui_.draw(target_);
    }
    void button_frame(const std::vector<platform::InputEvent>& events) {
        frame(events, [this] {
            if (ImGui::Button("Press", {80.0F, 60.0F})) ++presses_;
        });
    }
    void field_frame(const std::vector<platform::InputEvent>& events) {
        frame(events, [this] { ImGui::InputText("##field", text_.data(), text_.size()); });
    }

    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize.x, .height = kSize.y, .colours = {gpu::Format::RGBA8}}};
    platform::InputState input_;
    ui::Ui ui_;
    std::array<char, 32> text_{};
    int presses_ = 0;
};

TEST_F(UiTest, AClickPressesTheButtonUnderTheMouse) {
    button_frame({MouseMoveEvent{kOnButton}});
    button_frame({});
    button_frame({MouseButtonEvent{MouseButton::Left, true}});
    button_frame({MouseButtonEvent{MouseButton::Left, false}});
    button_frame({});
    EXPECT_EQ(presses_, 1);
}

TEST_F(UiTest, WithoutAClickNothingIsPressed) {
    button_frame({MouseMoveEvent{kOnButton}});
    for (int i = 0; i < 4; ++i) button_frame({});
    EXPECT_EQ(presses_, 0);
}

TEST_F(UiTest, AClickBesideTheButtonPressesNothing) {
    button_frame({MouseMoveEvent{kBesideWindow}});
    button_frame({});
    button_frame({MouseButtonEvent{MouseButton::Left, true}});
    button_frame({MouseButtonEvent{MouseButton::Left, false}});
    button_frame({});
    EXPECT_EQ(presses_, 0);
}

TEST_F(UiTest, AClickWithinOneFrameIsNotLost) {
    button_frame({MouseMoveEvent{kOnButton}});
    button_frame({});
    button_frame({MouseButtonEvent{MouseButton::Left, true}, MouseButtonEvent{MouseButton::Left, false}});
    button_frame({});
    EXPECT_EQ(presses_, 1);
}

TEST_F(UiTest, ADragWithinOneFrameMovesASliderAllTheWay) {
    float value = 0.0F;
    const auto slider = [&] {
        ImGui::SetNextItemWidth(80.0F);
        ImGui::SliderFloat("##slider", &value, 0.0F, 1.0F);
    };
    frame({MouseMoveEvent{{24.0, 28.0}}}, slider);
    frame({}, slider);
    frame({MouseButtonEvent{MouseButton::Left, true}, MouseMoveEvent{{104.0, 100.0}},
           MouseButtonEvent{MouseButton::Left, false}, MouseMoveEvent{{150.0, 20.0}}},
          slider);
    for (int i = 0; i < 3; ++i) frame({}, slider);
    EXPECT_EQ(value, 1.0F);
    frame({MouseMoveEvent{{24.0, 28.0}}}, slider);  // it was let go
    EXPECT_EQ(value, 1.0F);
}

TEST_F(UiTest, TheMouseIsTheInterfacesOnlyOverAWindow) {
    button_frame({MouseMoveEvent{kBesideWindow}});
    button_frame({});
    EXPECT_FALSE(ui_.wants_mouse());
    button_frame({MouseMoveEvent{kOnButton}});
    button_frame({});
    EXPECT_TRUE(ui_.wants_mouse());
}

TEST_F(UiTest, TypedTextGoesIntoTheFieldThatWasClicked) {
    field_frame({MouseMoveEvent{{40.0, 28.0}}});
    field_frame({CharEvent{U'x'}});
    EXPECT_FALSE(ui_.wants_text());
    field_frame({MouseButtonEvent{MouseButton::Left, true}});
    field_frame({MouseButtonEvent{MouseButton::Left, false}});
    EXPECT_TRUE(ui_.wants_text());
    EXPECT_TRUE(ui_.wants_keyboard());
    field_frame({CharEvent{U'7'}, CharEvent{U'4'}, CharEvent{U'\u03BB'}});
    field_frame({});
    EXPECT_STREQ(text_.data(), "74\u03BB");
    field_frame({KeyEvent{Key::Backspace, true}, KeyEvent{Key::Backspace, false}});
    field_frame({});
    EXPECT_STREQ(text_.data(), "74");
}

TEST_F(UiTest, AMouseThatHoldsAControlLeavesTheKeyboardToTheProgram) {
    button_frame({MouseMoveEvent{kOnButton}});
    button_frame({});
    button_frame({MouseButtonEvent{MouseButton::Left, true}});
    button_frame({});
    EXPECT_TRUE(ui_.wants_mouse());
    EXPECT_FALSE(ui_.wants_keyboard());
}

TEST_F(UiTest, TheKeyboardReachesTheButtonWithoutAMouse) {
    button_frame({});
    EXPECT_FALSE(ui_.wants_keyboard());
    for (const Key key : {Key::Down, Key::Space}) {
        button_frame({KeyEvent{key, true}});
        button_frame({KeyEvent{key, false}});
        button_frame({});
    }
    EXPECT_EQ(presses_, 1);
    EXPECT_TRUE(ui_.wants_keyboard());
}

TEST_F(UiTest, IsDrawnOverWhatIsThereAndNowhereElse) {
    button_frame({});
    const std::vector<glm::vec4> pixels = target_.read_rgba_float();
    const auto at = [&](int x, int y) { return pixels[static_cast<std::size_t>(y * kSize.x + x)]; };
    EXPECT_EQ(at(130, 60), glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
    EXPECT_GT(at(100, 80).r, 0.0F);
}

/// What a renderer relies on beside PipelineState, which sets all it has.
std::vector<GLint> gl_state() {
    std::vector<GLint> state;
    for (const GLenum name : std::initializer_list<GLenum>{
             GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_ACTIVE_TEXTURE, GL_TEXTURE_BINDING_2D, GL_SAMPLER_BINDING,
             GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_PRIMITIVE_RESTART,
             GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB,
             GL_ARRAY_BUFFER_BINDING, GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH}) {
        GLint value = 0;
        glGetIntegerv(name, &value);
        state.push_back(value);
    }
    std::array<GLint, 8> areas{};
    glGetIntegerv(GL_VIEWPORT, areas.data());
    glGetIntegerv(GL_SCISSOR_BOX, areas.data() + 4);
    state.insert(state.end(), areas.begin(), areas.end());
    return state;
}

TEST_F(UiTest, LeavesTheStateOfTheContextAsItWas) {
    button_frame({});
    const gpu::Program program = build_full_screen(
        "#version 450 core\nlayout(location = 0) out vec4 colour;\nvoid main() { colour = vec4(1.0); }\n");
    const gpu::Texture texture(gpu::TextureDesc{});
    gpu::apply({.depth_test = gpu::DepthTest::LessEqual, .blend = gpu::Blend::Premultiplied});
    program.use();
    texture.bind(0);
    target_.bind();
    const std::vector<GLint> before = gl_state();
    button_frame({});
    EXPECT_EQ(gl_state(), before);
}

TEST_F(UiTest, ALargerScaleMakesLargerText) {
    float before = 0.0F;
    frame({}, [&] { before = ImGui::CalcTextSize("Rowland").x; });
    ui_.set_scale(2.0F);
    float after = 0.0F;
    frame({}, [&] { after = ImGui::CalcTextSize("Rowland").x; });
    EXPECT_NEAR(after / before, 2.0F, 0.1F);  // glyphs are placed on whole pixels
}

TEST_F(UiTest, TheFontHasThePhysicistsLetters) {
    frame({}, [] {
        for (const char16_t letter : std::u16string(u"ληΣ±−√→"))
            EXPECT_NE(ImGui::GetFont()->FindGlyphNoFallback(letter), nullptr) << int{letter};
    });
}

}  // namespace
}  // namespace rowland
