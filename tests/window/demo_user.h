#pragma once

#include <nlohmann/json.hpp>

#include "engine/image/byte_image.h"
#include "tests/window/window_user.h"

namespace rowland::test {

/// The demo in a window, paused, and its user. A step waits for what it asks for at most so long.
class DemoUser {
 public:
    /// Starts the demo with the arguments and `--output-folder folder`, and waits until it draws.
    DemoUser(const std::filesystem::path& folder, Command arguments);
    /// Leaves, if the test has not; what it ends with must be 0.
    ~DemoUser();
    DemoUser(const DemoUser&) = delete;
    DemoUser& operator=(const DemoUser&) = delete;

    void key(const std::string& name);
    void hold_key(const std::string& name) { user_.hold_key(name); }
    void release_key(const std::string& name) { user_.release_key(name); }
    void point_at(glm::ivec2 position);
    void click(glm::ivec2 position);
    void drag(glm::ivec2 from, glm::ivec2 distance);
    /// A drag that ends in motion.
    void throw_from(glm::ivec2 from, glm::ivec2 distance);
    void drop(const std::filesystem::path& file) { user_.drop(file); }

    /// A screenshot (F12).
    image::ByteImage shot();
    /// The first screenshot that differs from `before`, or the last one.
    image::ByteImage shot_unlike(const image::ByteImage& before, std::chrono::seconds limit);
    /// A screenshot that equals the one before it: nothing moves any more.
    image::ByteImage settled_shot(std::chrono::seconds limit);
    /// Waits until the window's title no longer says that maps are being filled.
    void wait_for_maps(std::chrono::seconds limit);
    /// Waits until the demo has said that.
    void wait_for_message(const std::string& text, std::chrono::seconds limit);
    /// Asks for the pixel under the mouse (F8) until a measured one is written. Returns its path, a JSON file.
    std::filesystem::path measured_pixel(std::chrono::seconds limit);

    /// What it has said until now.
    std::string messages() const { return user_.program().err(); }
    /// Leaves by Escape; returns all that was said.
    std::string leave();

 private:
    /// Where the demo writes its next screenshot or pixel.
    std::filesystem::path numbered(const char* format, int number) const;

    std::filesystem::path folder_;
    WindowUser user_;
    int shots_ = 0;
    int pixels_ = 0;
    bool left_ = false;
};

/// Whether two screenshots are equal.
bool same(const image::ByteImage& a, const image::ByteImage& b);

/// Part of a picture in pixels, without its right column and bottom row.
struct Region {
    int left, top, right, bottom;
};
/// Mean absolute difference of two screenshots of one size in a region, in steps of 255.
double difference(const image::ByteImage& a, const image::ByteImage& b, const Region& region);

}  // namespace rowland::test
