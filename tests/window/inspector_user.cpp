#include "tests/window/inspector_user.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace rowland::test {

namespace {

constexpr glm::ivec2 kInspectorScreen{1280, 800};
/// For what takes a second on a quiet machine, and much longer on one that draws in software and does other things.
constexpr auto kLimit = 180s;
/// Frames after which the inspector has seen an input: the one under way, and a whole one.
constexpr int kSeen = 2;

Command inspector_command(const std::filesystem::path& folder, Command arguments) {
    arguments.insert(arguments.begin(), program_to_try("ROWLAND_TEST_INSPECTOR", ROWLAND_INSPECTOR));
    arguments.insert(arguments.end(),
                     {"--controls", folder / "controls", "--layout", folder / "layout.json", "--size", "960x600"});
    return arguments;
}

/// Where the inspector will write its facts; those of an earlier one are removed.
std::filesystem::path no_facts(const std::filesystem::path& folder) {
    std::filesystem::remove(folder / "controls");
    std::filesystem::remove(folder / "controls.frames");
    return folder / "controls";
}

struct Rectangle {
    glm::dvec2 least{0.0};
    glm::dvec2 most{0.0};

    glm::ivec2 at(glm::dvec2 fraction) const { return {least + fraction * (most - least)}; }
};

Rectangle rectangle_in(const std::string& text) {
    std::istringstream numbers(text);
    Rectangle rectangle;
    numbers >> rectangle.least.x >> rectangle.least.y >> rectangle.most.x >> rectangle.most.y;
    return rectangle;
}

}  // namespace

InspectorUser::InspectorUser(const std::filesystem::path& folder, Command arguments, Surroundings surroundings)
    : facts_file_(no_facts(folder)),
      user_(kInspectorScreen, inspector_command(folder, std::move(arguments)), "Rowland: material inspector",
            std::move(surroundings)) {
    wait_for("picture", " ");
}

InspectorUser::~InspectorUser() {
    if (!left_) {
        EXPECT_EQ(leave(), 0);
    }
}

Facts InspectorUser::read_facts() const {
    Facts facts;
    std::ifstream file(facts_file_);
    for (std::string line; std::getline(file, line);)
        if (const std::size_t tab = line.find('\t'); tab != std::string::npos)
            facts[line.substr(0, tab)] = line.substr(tab + 1);
    return facts;
}

int InspectorUser::frames() const {
    int count = 0;
    std::ifstream file(std::filesystem::path(facts_file_) += ".frames");
    file >> count;  // 0 where the file is just being written
    return count;
}

void InspectorUser::wait_for_rest() {
    int last = 0;
    const bool rests = wait_until(
        [&] {
            const int before = std::exchange(last, frames());
            std::this_thread::sleep_for(1s);
            return last == before && last == frames();
        },
        kLimit);
    if (!rests) throw std::runtime_error("the inspector draws without end");
}

void InspectorUser::wait_for_frames(int count) {
    int first = 0;
    const bool drawn = wait_until(
        [&] {
            const int now = frames();
            if (first == 0 && now > 0) {
                first = now;
                // A key that the inspector does not use: it draws some frames, and sees all input before it.
                user_.key("F4");
            }
            return (first > 0 && now >= first + count) || !user_.program().alive();
        },
        kLimit);
    if (!drawn) throw std::runtime_error("the inspector draws no frames");
}

glm::ivec2 InspectorUser::middle_of(const std::string& control) const {
    std::string found;
    wait_until([&] { return !(found = read_facts()[control]).empty(); }, kLimit);
    if (found.empty()) throw std::runtime_error("no control '" + control + "'");
    return rectangle_in(found).at({0.5, 0.5});
}

void InspectorUser::press_at(glm::ivec2 position) {
    user_.move_to(position);
    wait_for_frames(kSeen);
    user_.press();
    wait_for_frames(kSeen);
}

void InspectorUser::click_at(glm::ivec2 position) {
    press_at(position);
    user_.release();
    wait_for_frames();
}

void InspectorUser::click(const std::string& control) {
    click_at(middle_of(control));
}

void InspectorUser::drag(const std::string& control, glm::ivec2 distance) {
    press_at(middle_of(control));
    user_.move_by(distance);
    wait_for_frames(kSeen);
    user_.release();
    wait_for_frames();
}

void InspectorUser::pick(glm::dvec2 fraction) {
    click_at(rectangle_in(read_facts()["picture"]).at(fraction));
}

void InspectorUser::key(const std::string& name) {
    user_.key(name);
    wait_for_frames();
}

void InspectorUser::type(const std::string& text) {
    user_.type(text);
    wait_for_frames();
}

void InspectorUser::enter(const std::string& text) {
    key("ctrl+a");
    type(text);
    key("Return");
}

void InspectorUser::drop(const std::filesystem::path& file) {
    user_.drop(file);
    wait_for_frames();
}

void InspectorUser::wait_for(const std::string& fact, const std::string& text) {
    if (!wait_until([&] { return read_facts()[fact].find(text) != std::string::npos; }, kLimit))
        throw std::runtime_error(fact + " never was '" + text + "' but is '" + read_facts()[fact] + "'");
}

Facts InspectorUser::facts() {
    wait_for_frames();
    return read_facts();
}

int InspectorUser::leave() {
    user_.key("ctrl+q");
    const std::string discard = "button Discard";
    wait_until(
        [&] {
            if (read_facts().contains(discard) && user_.program().alive()) {
                wait_for_frames();  // a popup finds its position in its first frames
                const std::string button = read_facts()[discard];
                if (!button.empty()) click_at(rectangle_in(button).at({0.5, 0.5}));
            }
            return !user_.program().alive();
        },
        kLimit);
    return wait_for_end();
}

int InspectorUser::wait_for_end() {
    left_ = true;
    return user_.program().wait().code;
}

}  // namespace rowland::test
