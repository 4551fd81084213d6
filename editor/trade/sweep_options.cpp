#include "editor/trade/sweep_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/utf8.h"

namespace rowland::trade {

namespace {

FrameSet parse_frames(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || text.find(',') < equals)
        refuse_input("--frames", "", fmt::format("\"{}\"", text), "NAME=FILE, without a comma in the name");
    return frames_of_file(valid_utf8(text.substr(0, equals)), text.substr(equals + 1));
}

}  // namespace

void SweepOptions::declare(CLI::App& command) {
    command.add_option("--material", materials, "Material, JSON; may be given several times")
        ->required()
        ->type_name("FILE");
    command
        .add_option(
            "--probe", probes,
            "Light probe, Radiance .hdr or OpenEXR; may be given several times. FILE:angular and FILE:equirect\n"
            "name its mapping. The first one lights the timed frames")
        ->required()
        ->type_name("FILE[:MAPPING]");
    command.add_option("--probe-mapping", mapping, "How probes without a mapping of their own cover the sphere")
        ->check(CLI::IsMember({"equirect", "angular"}))
        ->capture_default_str();
    command
        .add_option(
            "--frames", frames,
            "A set of frames of your own, CSV vx,vy,vz,nx,ny,nz,gx,gy,gz; may be given several times. One named\n"
            "tilted_cd or sphere replaces the tool's own")
        ->type_name("NAME=FILE");
    command
        .add_option("--setting", settings,
                    "Measures these settings in place of the plan, such as arc/bands=5/rank=8/key_lights=16: a\n"
                    "representation, then what a material file's \"quality\" takes, key_lights as a number, and window")
        ->type_name("SETTING");
    command.add_option("--picture-size", picture_size, "Pixels of the picture that errors are measured on")
        ->expected(2)
        ->check(CLI::Range(8, 1024))
        ->capture_default_str();
    command.add_option("--frame-size", frame_size, "Pixels of the frames that are timed")
        ->expected(2)
        ->check(CLI::Range(8, 8192))
        ->capture_default_str();
    command.add_flag("--no-times", no_times, "Times no frames; needs no OpenGL");
    command.add_option("--output", output, "Folder of the results. A sweep that was stopped goes on in its folder")
        ->required()
        ->type_name("FOLDER");
}

SweepInputs SweepOptions::inputs() const {
    SweepInputs result{.materials = materials,
                       .probes = {},
                       .frame_sets = {tilted_cd_frames(), sphere_frames()},
                       .settings = {},
                       .picture_size = {picture_size[0], picture_size[1]},
                       .frame_size = {frame_size[0], frame_size[1]},
                       .times = !no_times,
                       .folder = output};
    for (const std::string& probe : probes) result.probes.push_back(parse_probe_file(probe, mapping));
    for (const std::string& text : frames) {
        FrameSet set = parse_frames(text);
        const auto same = std::find_if(result.frame_sets.begin(), result.frame_sets.end(),
                                       [&](const FrameSet& other) { return other.name == set.name; });
        if (set.name == "picture") refuse_input("--frames", "", "the name picture", "another name");
        if (same != result.frame_sets.end()) {
            *same = std::move(set);
        } else {
            result.frame_sets.push_back(std::move(set));
        }
    }
    for (const std::string& text : settings) result.settings.push_back(parse_setting(text));
    return result;
}

}  // namespace rowland::trade
