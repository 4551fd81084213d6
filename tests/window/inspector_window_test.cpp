// The inspector in a real window, used by real mouse and keys under Xvfb. What each step did is read from the facts
// that the inspector keeps for its drivers; leave a step out, and what is expected after it fails.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "modules/diffraction/asset/material_json.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"
#include "tests/window/needs_xvfb.h"

namespace rowland {
namespace {

using testing::HasSubstr;

class InspectorWindow : public ::testing::Test {
 protected:
    /// Starts the inspector, plays the actions and ends it.
    void play(const std::vector<std::string>& actions, const std::string& arguments = {}) {
        EXPECT_EQ(status_of(actions, std::string(ROWLAND_INSPECTOR) + " " + arguments), 0);
    }
    /// The same by a command of one's own; returns its exit status.
    int status_of(const std::vector<std::string>& actions, const std::string& inspector) {
        // A small probe: the reference is quick under it.
        write_file_atomic(
            folder_.path() / "sky.json",
            R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 40, "sun_elevation_deg": 35, "width": 128}})");
        std::string command = std::string("DROP_FILES=" ROWLAND_DROP_FILES " bash ") + ROWLAND_INSPECTOR_DRIVE + " " +
                              folder_.path().string();
        for (const std::string& action : actions) command += " '" + action + "'";
        command += " -- " + inspector;
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    /// A fact that was kept.
    std::string fact(const std::string& file, const std::string& name) const {
        std::ifstream text(path(file));
        for (std::string line; std::getline(text, line);)
            if (line.starts_with(name + "\t")) return line.substr(name.size() + 1);
        ADD_FAILURE() << "no " << name << " in " << file;
        return {};
    }
    nlohmann::json material(const std::string& file) const {
        return nlohmann::json::parse(fact(file, "material"), nullptr, false);
    }

    test::TemporaryFolder folder_;
};

TEST_F(InspectorWindow, AMaterialIsEditedPickedLitSavedAndOpenedAgain) {
    ROWLAND_NEEDS_XVFB();
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    play({"click:menu Presets",
          "click:menu cd",
          "until:document=cd.json",
          "keep:preset",
          "drag:/grating/pitch_nm,-86,0",
          "keep:dragged",
          "click:lines per mm",
          "key:ctrl+a",
          "type:1200",
          "key:Return",
          "keep:typed",
          "click:/grating/profile",
          "click:/grating/profile=blazed",
          "keep:blazed",
          "key:ctrl+z",
          "key:ctrl+z",
          "keep:undone_twice",
          "key:ctrl+z",
          "keep:undone",
          "until:busy=no",
          "pick:0.66,0.5",
          "until:busy=no",
          "keep:picked",
          "key:ctrl+o",
          "type:" + probe.string(),
          "key:Return",
          "until:light=venice_sunset_256.hdr",
          "until:busy=no",
          "keep:lit",
          "shot:lit.png",
          "click:/metal",
          "click:/metal=Au",
          "keep:gold",
          "key:ctrl+s",
          "key:ctrl+a",
          "type:" + path("mine.json"),
          "key:Return",
          "until:message=saved",
          "keep:saved"},
         "--preset dvd --probe " + path("sky.json"));
    EXPECT_EQ(material("preset")["grating"]["pitch_nm"], 1600);
    EXPECT_EQ(material("dragged")["grating"]["pitch_nm"], 740);
    EXPECT_EQ(material("dragged")["grating"]["profile"]["width_nm"], 370);
    EXPECT_EQ(material("typed")["grating"]["pitch_nm"], 833.333);
    EXPECT_EQ(material("blazed")["grating"]["profile"]["type"], "blazed");
    EXPECT_EQ(material("undone_twice")["grating"]["pitch_nm"], 740);
    EXPECT_EQ(material("undone"), material("preset"));
    EXPECT_THAT(fact("picked", "picked"), testing::MatchesRegex("[0-9]+ [0-9]+ [0-9]+"));
    EXPECT_NE(fact("lit", "point"), fact("picked", "point"));
    EXPECT_NE(fact("lit", "picked"), fact("picked", "picked"));
    EXPECT_EQ(material("gold")["metal"], "Au");
    EXPECT_EQ(fact("saved", "document"), "mine.json");

    EXPECT_EQ(diffraction::load_material(path("mine.json")).grating.metal, colour::Metal::Au);
    play({"until:document=mine.json", "until:light=venice", "keep:opened"}, path("mine.json"));
    EXPECT_EQ(material("opened"), material("gold"));
    EXPECT_EQ(fact("opened", "light"), "venice_sunset_256.hdr");  // the layout remembers it
}

TEST_F(InspectorWindow, EditsOutliveALostContext) {
    ROWLAND_NEEDS_XVFB();
    const std::string text = R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})";
    write_file_atomic(path("mine.json"), text);
    EXPECT_EQ(status_of({"until:document=mine.json", "click:lines per mm", "key:ctrl+a", "type:1250", "key:Return",
                         "keep:typed", "run:touch " + path("lost")},
                        "env LD_PRELOAD=" ROWLAND_LOST_CONTEXT " ASAN_OPTIONS=verify_asan_link_order=0 " +
                            ("ROWLAND_TEST_LOST_WHEN=" + path("lost")) + " " ROWLAND_INSPECTOR " " + path("mine.json")),
              1);
    EXPECT_EQ(diffraction::load_material(path("mine.unsaved.json")).grating.pitch_nm, 800);
    EXPECT_EQ(nlohmann::json::parse(read_text_file(path("mine.unsaved.json"), 1 << 20)), material("typed"));
    EXPECT_EQ(read_text_file(path("mine.json"), 1 << 20), text);
}

TEST_F(InspectorWindow, WhatIsRefusedIsSaidAndNothingIsLost) {
    ROWLAND_NEEDS_XVFB();
    write_file_atomic(path("corrupt.json"), "{\"grating\": {\"pitch_nm\": 16");
    write_file_atomic(path("huge.json"), std::string(40 << 20, ' '));
    const auto open = [&](const std::string& name) {
        return std::vector<std::string>{"key:ctrl+o", "type:" + path(name), "key:Return", "until:message=" + name};
    };
    // A message stays until the next one.
    std::vector<std::string> actions = {"until:message=the light",
                                        "click:/grating/orders",
                                        "key:ctrl+a",
                                        "type:1 x",
                                        "key:Return",
                                        "until:refused=orders",
                                        "keep:refused",
                                        "key:ctrl+s",
                                        "wait:0.5",
                                        "key:ctrl+a",
                                        "type:/proc/nowhere/m.json",
                                        "key:Return",
                                        "until:message=orders",
                                        "key:ctrl+z",
                                        "until:refused=no",
                                        "key:ctrl+s",
                                        "wait:0.5",
                                        "key:ctrl+a",
                                        "type:/proc/nowhere/m.json",
                                        "key:Return",
                                        "until:message=/proc/nowhere"};
    for (const char* name : {"corrupt.json", "huge.json", "missing.hdr"})
        for (const std::string& action : open(name)) actions.push_back(action);
    actions.insert(actions.end(), {"keep:end"});
    play(actions, "--preset cd --probe " + path("sky.json"));
    EXPECT_THAT(fact("refused", "refused"), HasSubstr("/grating/orders"));
    EXPECT_EQ(fact("end", "document"), "cd.json *");
    EXPECT_EQ(material("end")["grating"]["orders"], nlohmann::json({-2, -1, 1, 2}));
}

TEST_F(InspectorWindow, DroppedFilesAreOpenedAsWhatTheyAre) {
    ROWLAND_NEEDS_XVFB();
    ROWLAND_TEST_DATA(probe, "probes/venice_sunset_256.hdr");
    write_file_atomic(
        path("gold rule.json"),
        R"({"grating": {"pitch_nm": 1000, "profile": {"type": "slit", "width_nm": 500}}, "metal": "Au"})");
    write_file_atomic(path("letter.txt"), "Dear Henry,\n");
    play({"drop:" + probe.string(), "until:light=venice_sunset_256.hdr", "drop:" + path("gold rule.json"),
          "until:document=gold rule.json", "drop:" + path("letter.txt"), "until:message=letter.txt", "keep:dropped"},
         "--preset dvd --probe " + path("sky.json"));
    EXPECT_EQ(fact("dropped", "document"), "gold rule.json");
    EXPECT_EQ(fact("dropped", "light"), "venice_sunset_256.hdr");
    EXPECT_EQ(material("dropped")["metal"], "Au");
}

TEST_F(InspectorWindow, TheLayoutSurvivesARestart) {
    ROWLAND_NEEDS_XVFB();
    play({"keep:before", "drag:left splitter,40,0", "key:ctrl+equal", "click:shape", "click:shape=card", "wait:0.5",
          "keep:after"},
         "--probe " + path("sky.json"));
    play({"wait:0.5", "keep:again"});
    EXPECT_NE(fact("before", "picture"), fact("after", "picture"));
    EXPECT_EQ(fact("again", "picture"), fact("after", "picture"));
    EXPECT_EQ(fact("again", "shape is"), "card");
}

}  // namespace
}  // namespace rowland
