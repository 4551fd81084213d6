#pragma once

#include <chrono>
#include <glm/vec4.hpp>
#include <thread>

#include "editor/inspector/session.h"
#include "engine/core/file.h"
#include "engine/platform/gl_context.h"
#include "tests/support/folder_test.h"
#include "tests/support/light.h"

namespace rowland::inspector {

/// A session without a window, whose picture is small and whose light is quick for the reference.
class SmallSession : public test::FolderTest {
 protected:
    /// `base`: a member of the material, or nothing.
    explicit SmallSession(const std::string& base) {
        write_file_atomic(path("sky.json"), test::small_sky(64, 1));
        write_file_atomic(
            path("m.json"),
            R"({"grating": {"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 800}}, )" + base +
                R"("quality": {"representation": "spikes", "bands": 3, "spikes": 2}})");
        session_.light.choose(path("sky.json"));
    }

    void draw(int frames, bool with_saved = false) {
        for (int i = 0; i < frames; ++i) {
            session_.update();
            session_.view.draw(kSize, opening_camera(), with_saved, 0.01F);
        }
    }
    /// Frames until a condition holds; fails after two minutes.
    template <typename Condition>
    void draw_until(Condition&& holds, bool with_saved = false) {
        for (int i = 0; i < 24000 && !holds(); ++i) {
            draw(1, with_saved);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ASSERT_TRUE(holds());
    }
    const Document& document() const { return session_.opened.document(); }
    Document& document() { return session_.opened.document(); }
    const Message& last_message() const { return session_.messages.all().back(); }
    std::vector<glm::vec4> picture() const { return session_.view.preview().linear().read_rgba_float(); }
    std::vector<std::uint8_t> display() const { return session_.view.preview().display().read_rgba8(); }

    static constexpr glm::ivec2 kSize{64, 48};
    platform::HeadlessContext context_;
    post::OcioConfig config_ = post::OcioConfig::choose(std::nullopt);
    Session session_{config_, {.content_folder = test::source_path("content"), .still = true}};
};

}  // namespace rowland::inspector
