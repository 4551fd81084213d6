#include "tests/window/demo_user.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

#include "engine/core/file.h"

namespace rowland::test {

namespace {

constexpr glm::ivec2 kDemoScreen{1024, 768};
/// Longer than a frame at the tests' sizes: the demo sees each step by itself.
constexpr auto kStep = 100ms;

Command demo_command(const std::filesystem::path& folder, Command arguments) {
    arguments.insert(arguments.begin(), ROWLAND_DEMO);
    arguments.insert(arguments.end(), {"--output-folder", folder.string()});
    return arguments;
}

/// Whether a window's title says how long the demo's frames take.
bool draws(const std::string& title) {
    return title.find(" ms a frame") != std::string::npos;
}

}  // namespace

DemoUser::DemoUser(const std::filesystem::path& folder, Command arguments)
    : folder_(folder), user_(kDemoScreen, demo_command(folder, std::move(arguments)), "Rowland") {
    if (!wait_until([&] { return draws(user_.title()) || !user_.program().alive(); }, 120s))
        throw std::runtime_error("the demo does not draw: " + messages());
}

DemoUser::~DemoUser() {
    if (!left_ && !testing::Test::HasFatalFailure()) leave();
}

void DemoUser::key(const std::string& name) {
    user_.key(name);
    std::this_thread::sleep_for(kStep);
}

void DemoUser::point_at(glm::ivec2 position) {
    user_.move_to(position);
    std::this_thread::sleep_for(kStep);
}

void DemoUser::click(glm::ivec2 position) {
    drag(position, {});
}

void DemoUser::drag(glm::ivec2 from, glm::ivec2 distance) {
    point_at(from);
    user_.press();
    std::this_thread::sleep_for(kStep);
    if (distance != glm::ivec2(0)) {
        user_.move_by(distance);
        std::this_thread::sleep_for(kStep);
    }
    user_.release();
    std::this_thread::sleep_for(kStep);
}

void DemoUser::throw_from(glm::ivec2 from, glm::ivec2 distance) {
    point_at(from);
    user_.press();
    std::this_thread::sleep_for(kStep);
    // Lasts longer than a frame, so that one of them ends in motion.
    user_.release_in_motion(distance, 30, 20ms);
}

std::filesystem::path DemoUser::numbered(const char* format, int number) const {
    return folder_ / fmt::format(fmt::runtime(format), number);
}

image::ByteImage DemoUser::shot() {
    // An earlier demo may have left some.
    while (std::filesystem::exists(numbered("screenshot_{:04}.png", shots_))) ++shots_;
    const std::filesystem::path file = numbered("screenshot_{:04}.png", shots_++);
    user_.key("F12");
    EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(file); }, 180s)) << messages();
    return image::decode_byte_image(read_file(file, 1 << 24), file.string());
}

image::ByteImage DemoUser::shot_unlike(const image::ByteImage& before, std::chrono::seconds limit) {
    image::ByteImage picture;
    wait_until([&] { return !same(picture = shot(), before); }, limit);
    return picture;
}

image::ByteImage DemoUser::settled_shot(std::chrono::seconds limit) {
    image::ByteImage picture = shot();
    wait_until(
        [&] {
            std::this_thread::sleep_for(300ms);
            const image::ByteImage before = std::exchange(picture, shot());
            return same(picture, before);
        },
        limit);
    return picture;
}

void DemoUser::wait_for_maps(std::chrono::seconds limit) {
    std::this_thread::sleep_for(600ms);  // the title is updated every half a second
    wait_until(
        [&] {
            const std::string title = user_.title();
            return draws(title) && title.find("filling maps") == std::string::npos;
        },
        limit);
}

void DemoUser::wait_for_message(const std::string& text, std::chrono::seconds limit) {
    wait_until([&] { return messages().find(text) != std::string::npos; }, limit);
}

std::filesystem::path DemoUser::measured_pixel(std::chrono::seconds limit) {
    while (std::filesystem::exists(numbered("pixel_{:04}.json", pixels_))) ++pixels_;
    const std::filesystem::path file = numbered("pixel_{:04}.json", pixels_++);
    wait_until(
        [&] {
            if (std::filesystem::exists(file)) return true;
            user_.key("F8");
            std::this_thread::sleep_for(300ms);
            return false;
        },
        limit);
    std::this_thread::sleep_for(1s);  // what was asked for meanwhile is written as well
    while (std::filesystem::exists(numbered("pixel_{:04}.json", pixels_))) ++pixels_;
    return numbered("pixel_{:04}.json", pixels_ - 1);
}

std::string DemoUser::leave() {
    user_.key("Escape");
    left_ = true;
    const Ended ended = user_.program().wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.err;
}

bool same(const image::ByteImage& a, const image::ByteImage& b) {
    return a.width == b.width && a.rgba == b.rgba;
}

double difference(const image::ByteImage& a, const image::ByteImage& b, const Region& region) {
    double sum = 0.0;
    for (int y = region.top; y < region.bottom; ++y)
        for (int x = 4 * region.left; x < 4 * region.right; ++x) {
            const auto i = static_cast<std::size_t>(4 * y * a.width + x);
            sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
        }
    return sum / (3.0 * (region.right - region.left) * (region.bottom - region.top));
}

}  // namespace rowland::test
