#pragma once

#include <nlohmann/json.hpp>

#include "tests/window/window_user.h"

namespace rowland::test {

/// What the inspector's option --controls writes: by the name of a control its rectangle "left top right bottom" in
/// pixels, by that of a fact its text. The file itself, a line each, is `name <tab> value`.
using Facts = std::map<std::string, std::string>;

/// The inspector in a window, and its user, who finds controls by their names. A step waits for its control, and until
/// the inspector has drawn what it changed; what does not come is a std::runtime_error that says so.
class InspectorUser {
 public:
    /// Starts the inspector in a small window, whose frames a software renderer draws in half the time of the default
    /// one, with its layout kept in `folder`, and waits for its picture.
    InspectorUser(const std::filesystem::path& folder, Command arguments, Surroundings surroundings = {});
    /// Leaves, if the test has not; the exit code must be 0.
    ~InspectorUser();
    InspectorUser(const InspectorUser&) = delete;
    InspectorUser& operator=(const InspectorUser&) = delete;

    void click(const std::string& control);
    void drag(const std::string& control, glm::ivec2 distance);
    /// Clicks the picture at these fractions of its width and height.
    void pick(glm::dvec2 fraction);
    void key(const std::string& name);
    void type(const std::string& text);
    /// Selects all of a control that holds the keyboard, types over it and ends with Return.
    void enter(const std::string& text);
    void drop(const std::filesystem::path& file);

    /// Waits until the fact contains `text`.
    void wait_for(const std::string& fact, const std::string& text);
    /// All facts once everything until now is drawn.
    Facts facts();

    /// The number of frames that were drawn.
    int frames() const;
    /// Waits until no frame was drawn for a second.
    void wait_for_rest();

    /// Leaves by Ctrl+Q and discards unsaved edits; returns the exit code.
    int leave();
    /// Waits for an end of itself; returns the exit code.
    int wait_for_end();

 private:
    Facts read_facts() const;
    /// Waits for so many frames. After two the inspector has seen the last input; a popup finds its position in two
    /// more.
    void wait_for_frames(int count = 5);
    /// The middle of a control, once it is there.
    glm::ivec2 middle_of(const std::string& control) const;
    void click_at(glm::ivec2 position);
    void press_at(glm::ivec2 position);

    std::filesystem::path facts_file_;
    WindowUser user_;
    bool left_ = false;
};

}  // namespace rowland::test
