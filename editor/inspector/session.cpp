#include "editor/inspector/session.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace rowland::inspector {

namespace {

/// The shape on which a preset shows its colours without a change of view. The sheet is bent, so that light and view
/// are grazing somewhere on it: only there the finest grooves diffract visible light and the coarsest reflect a streak.
PreviewShape shape_of_preset(const std::string& name) {
    return name.starts_with("cd") || name == "dvd" ? PreviewShape::Disc : PreviewShape::Sheet;
}

}  // namespace

Session::Session(const post::OcioConfig& config, const SessionSettings& settings)
    : light({settings.content_folder / "probes", settings.captures}, settings.probe_mapping, messages),
      opened(settings.content_folder / "materials", messages),
      view(config, settings.still, opened, light, messages),
      measurement(opened, light, view, messages) {}

void Session::open(const std::filesystem::path& path) {
    bool is_light = false;
    if (!messages.attempt([&] { is_light = is_light_file(path); })) return;
    is_light ? light.choose(path) : opened.open(path);
}

void Session::open_preset(const std::string& name) {
    if (!opened.open_preset(name) || opened.document().is_scene()) return;
    const Document& document = opened.document();
    const bool lattice = document.has_grating() && document.material().grating.lattice.has_value();
    view.choose_shape(document.has_film() ? PreviewShape::Sphere
                      : lattice           ? PreviewShape::Card
                                          : shape_of_preset(name));
}

void Session::open_in_demo() {
    messages.attempt([&] {
        std::vector<std::string> arguments = opened.demo_arguments();
        const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rowland-demo";
        arguments.insert(arguments.begin(), program.string());
        if (light.current())
            arguments.insert(arguments.end(), {"--probe", std::filesystem::absolute(light.current()->path).string()});
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        pid_t process = -1;
        const int code = posix_spawn(&process, program.c_str(), nullptr, nullptr, pointers.data(), environ);
        if (code != 0)
            fail_system(program.string(), std::strerror(code), "build or install the demo beside this program");
        std::thread([process] { waitpid(process, nullptr, 0); }).detach();  // or the closed demo stays as a zombie
        messages.say("the demo starts");
    });
}

bool Session::update() {
    bool news = opened.update();
    view.update();
    news = light.update() || news;
    news = measurement.update() || news;
    const bool before = std::exchange(was_busy_, busy());
    return news || was_busy_ != before;
}

}  // namespace rowland::inspector
