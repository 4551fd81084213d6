// The program rowland-inspector: options, the window and captures.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "editor/inspector/layout.h"
#include "editor/inspector/session.h"
#include "editor/inspector/workbench.h"
#include "engine/app/drawing_program.h"
#include "engine/app/window_loop.h"
#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/core/program.h"
#include "engine/gpu/context.h"
#include "engine/gpu/framebuffer.h"
#include "engine/ui/ui.h"
#include "engine/view/picture.h"

namespace rowland::inspector {
namespace {

/// The values of the command line.
struct Options : app::CommonOptions {
    std::optional<std::filesystem::path> file;  ///< material, foil recipe or glTF
    std::optional<std::string> preset;
    std::optional<PreviewShape> shape;
    bool preview_only = false;
    bool measure = false;
    int width = 0;  ///< 0: the layout's
    int height = 0;
    float scale = 0.0F;                           ///< 0: the layout's
    std::optional<std::filesystem::path> layout;  ///< none: the user's
    std::optional<std::filesystem::path> controls;
};

constexpr const char* kFooter =
    "example:\n"
    "  rowland-inspector my_foil.json --probe stage.hdr --shape sheet\n"
    "  rowland-inspector --preset dvd --capture inspector.png --size 1600x1000\n\n"
    "Drop a material, a foil recipe, a glTF file, a probe, a picture or a table of efficiencies onto the window.\n"
    "Keys: F1 lists all. Tab and arrows move through all controls, Space and Enter use them; Ctrl+Z undoes and\n"
    "Ctrl+Shift+Z redoes, Ctrl+S saves, Ctrl+O opens, Ctrl+= and Ctrl+- change the size of text, Ctrl+1 to Ctrl+5\n"
    "choose the shape, F6 compares with the saved version, F12 writes a screenshot. Drag the preview to orbit, turn\n"
    "the wheel to zoom, click to pick a point.";

void read_size(const std::string& text, Options& options) {
    int used = 0;
    const bool read = std::sscanf(text.c_str(), "%5dx%5d%n", &options.width, &options.height, &used) == 2;
    const auto sane = [](int size) { return size >= 320 && size <= 8192; };
    if (!read || static_cast<std::size_t>(used) != text.size() || !sane(options.width) || !sane(options.height))
        throw CLI::ValidationError("--size", "'" + text + "' is no size such as 1280x800, each side 320 to 8192");
}

void check_outputs(const Options& options) {
    std::vector<Output> outputs;
    if (options.capture) outputs.push_back({"--capture", *options.capture, ".png"});
    if (options.controls) outputs.push_back({"--controls", *options.controls});
    if (options.layout && !options.capture) outputs.push_back({"--layout", *options.layout});
    std::vector<std::filesystem::path> inputs = app::given({options.file, options.probe, options.ocio_config});
    if (options.preset) inputs.push_back(options.content_folder / "materials" / (*options.preset + ".json"));
    rowland::check_outputs(inputs, outputs);
}

/// Prints help and returns nullopt if only help was requested. Throws Error (input) for bad usage, and for an output
/// file that cannot be written or is also an input.
std::optional<Options> parse_options(int argc, const char* const* argv) {
    CLI::App app{
        "Rowland's material inspector: edit a grating or a thin film and see its colours, its physics and its cost.",
        "rowland-inspector"};
    app.footer(kFooter);
    Options options;
    options.content_folder = resources_folder(ROWLAND_SOURCE_DIR) / "content";
    std::string shape;
    app.add_option("FILE", options.file,
                   "A material or a foil recipe (.json), or a glTF file whose gratings and films to edit");
    app.add_option("--preset", options.preset, "Start from a shipped material: cd, cd_r, dvd, blu_ray, soap_film, …");
    app::add_common_options(app, options, "Write the window as PNG once all is computed, without opening a window");
    app.add_option("--shape", shape, "Shape of the preview: disc, sphere, card, sheet")
        ->check(CLI::IsMember({"disc", "sphere", "card", "sheet"}));
    app.add_flag("--preview-only", options.preview_only, "Capture the preview alone");
    app.add_flag("--measure", options.measure, "Measure all choices before the capture");
    app.add_option_function<std::string>(
        "--size", [&](const std::string& text) { read_size(text, options); },
        "Size of the window or the capture, as 1280x800");
    app.add_option("--scale", options.scale, "Size of text and controls")->check(finite(0.5, 4.0));
    app.add_option("--layout", options.layout, "File of the layout (default: in the user's configuration)");
    app.add_option("--controls", options.controls, "Write the positions of all controls to a file, for automation");
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    options.shape = parse_preview_shape(shape);
    check_outputs(options);
    return options;
}

/// Ends the program with status 2; the log has the reason already.
struct Refused {};

/// Throws Refused if the last file of the command line was refused.
void require_opened(const Session& session) {
    const std::vector<Message>& messages = session.messages.all();
    if (!messages.empty() && messages.back().failure) throw Refused{};
}

/// The layout file of the options, overridden by the other options.
Layout chosen_layout(const Options& options) {
    Layout layout;
    if (const auto file = options.layout ? options.layout : default_layout_file()) layout = load_layout(*file);
    if (options.width > 0) layout.width = options.width;
    if (options.height > 0) layout.height = options.height;
    if (options.scale > 0.0F) layout.scale = options.scale;
    if (options.shape) layout.shape = preview_shape_name(*options.shape);
    return layout;
}

/// The interior, whose windows and lamps show a grating's colours on every shape, or else the studio.
std::filesystem::path default_light(const std::vector<std::filesystem::path>& lights) {
    for (const char* name : {"captured_interior", "studio"})
        for (const std::filesystem::path& light : lights)
            if (light.stem() == name) return light;
    return lights.front();
}

/// The folder of the recipes of captured probes, among the cooked assets beside this program.
std::filesystem::path capture_recipes() {
    return program_prefix() / "cooked" / "recipes";
}

SessionSettings session_settings(const Options& options, bool still) {
    return {.content_folder = options.content_folder,
            .probe_mapping = options.probe_mapping,
            .captures = capture_recipes(),
            .still = still};
}

/// Opens the files of the options, else of the layout. Throws Refused if a file of the options is refused; a
/// probe of the layout that no longer exists is ignored.
void start_session(Session& session, const Options& options, const Layout& layout) {
    session.view.stage = layout.stage;
    if (const auto shape = parse_preview_shape(layout.shape)) session.view.choose_shape(*shape);
    if (options.preset) {
        session.open_preset(*options.preset);
        if (options.shape) session.view.choose_shape(*options.shape);
        require_opened(session);
    }
    if (options.file) {
        session.open(*options.file);
        session.opened.finish_opening();
        require_opened(session);
    }
    std::error_code ignored;
    if (options.probe)
        session.light.choose(*options.probe);
    else if (!layout.light.empty() && std::filesystem::exists(layout.light, ignored))
        session.light.choose(layout.light);
    else if (const auto lights = session.light.shipped(); !lights.empty())
        session.light.choose(default_light(lights));
}

/// Writes the window into the current folder, under a new name.
void write_screenshot(Messages& messages, const gpu::Framebuffer& window) {
    const std::filesystem::path path = app::unused_file(std::filesystem::current_path(), "screenshot", ".png");
    if (messages.attempt([&] { view::write_display_capture(window, path); }))
        messages.say(path.string() + ": the window");
}

/// The contents of the inspector's window, drawn into a framebuffer.
class WindowFrame {
 public:
    /// All but `options` must outlive it.
    WindowFrame(const Options& options, const post::OcioConfig& config, Session& session, Layout& layout);

    Workbench& workbench() { return workbench_; }
    /// `frame` as for ui::Ui; `keys`: whether shortcuts work and messages are shown; `frame_ms`: to show, 0: none.
    const gpu::Framebuffer& draw(const platform::InputState& input, bool keys, const ui::UiFrame& frame,
                                 double frame_ms);

 private:
    Layout& layout_;
    Session& session_;
    ui::Ui ui_;
    ControlMap controls_;
    Workbench workbench_;
    std::optional<gpu::Framebuffer> target_;
};

WindowFrame::WindowFrame(const Options& options, const post::OcioConfig& config, Session& session, Layout& layout)
    : layout_(layout),
      session_(session),
      ui_(layout.scale),
      controls_(options.controls),
      workbench_(config, session, layout, controls_) {}

const gpu::Framebuffer& WindowFrame::draw(const platform::InputState& input, bool keys, const ui::UiFrame& frame,
                                          double frame_ms) {
    if (layout_.scale != ui_.scale()) ui_.set_scale(layout_.scale);
    ui_.begin_frame(input, frame);
    workbench_.draw(input, keys && !ui_.wants_text(),
                    {.size = glm::vec2(frame.size),
                     .pixels_per_unit = static_cast<float>(frame.framebuffer_size.x) / static_cast<float>(frame.size.x),
                     .seconds = static_cast<float>(frame.seconds),
                     .frame_ms = frame_ms,
                     .in_window = keys});
    const glm::ivec2 pixels = frame.framebuffer_size;
    if (!target_ || target_->size() != pixels)
        target_.emplace(gpu::FramebufferDesc{.width = pixels.x, .height = pixels.y, .colours = {gpu::Format::RGBA8}});
    target_->clear({0.05F, 0.05F, 0.05F, 1.0F});
    ui_.draw(*target_);
    if (workbench_.take_screenshot()) write_screenshot(session_.messages, *target_);
    return *target_;
}

constexpr double kFrame_s = 1.0 / 30.0;

/// Waits for background work.
void settle(Session& session) {
    do {
        session.update();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } while (session.busy());
    session.update();
}

void require_picture(const Session& session) {
    if (session.view.ready()) return;
    require_opened(session);
    refuse_input({}, {}, session.messages.all().empty() ? "no light" : session.messages.all().back().text, {},
                 "nothing was written");
}

void capture_preview(Session& session, const Options& options, glm::ivec2 size) {
    // Maps fill in the second frame without motion.
    for (int frame = 0; frame < 2; ++frame)
        session.view.draw(size, opening_camera(), false, static_cast<float>(kFrame_s));
    view::write_display_capture(session.view.preview().display(), *options.capture);
}

void capture_window(Session& session, const Options& options, const post::OcioConfig& config, Layout layout) {
    WindowFrame window_frame(options, config, session, layout);
    const glm::ivec2 size(layout.width, layout.height);
    const platform::InputState no_input;
    const auto draw_frame = [&]() -> const gpu::Framebuffer& {
        session.update();
        return window_frame.draw(no_input, false, {.size = size, .framebuffer_size = size, .seconds = kFrame_s}, 0.0);
    };
    draw_frame();
    if (options.measure) session.measurement.measure_all();
    // The panes' numbers at a point are computed once there is a picture.
    do {
        draw_frame();
        settle(session);
    } while (session.busy() || window_frame.workbench().due());
    for (int frame = 0; frame < 2; ++frame) draw_frame();
    view::write_display_capture(draw_frame(), *options.capture);
}

/// Writes the window as PNG once all values are computed. Needs no display.
void capture(const Options& options, const post::OcioConfig& config) {
    app::render_offscreen(options.gl_debug, [&](const std::string&) {
        const Layout layout = chosen_layout(options);
        Session session(config, session_settings(options, true));
        start_session(session, options, layout);
        settle(session);
        require_picture(session);
        if (options.preview_only)
            capture_preview(session, options, {layout.width, layout.height});
        else
            capture_window(session, options, config, layout);
    });
}

/// The inspector does not use game pads; every poll of the window adds a gamepad event.
bool is_of_user(const platform::InputEvent& event) {
    return !std::holds_alternative<platform::GamepadEvent>(event);
}

class Program {
 public:
    Program(const Options& options, const post::OcioConfig& config)
        : layout_file_(options.layout ? options.layout : default_layout_file()),
          layout_(chosen_layout(options)),
          loop_("Rowland: material inspector", {layout_.width, layout_.height}, options.gl_debug),
          session_(config, session_settings(options, false)),
          window_frame_(options, config, session_, layout_) {
        start_session(session_, options, layout_);
        std::error_code ignored;
        const std::filesystem::path unsaved = std::exchange(layout_.unsaved, {});
        if (std::filesystem::is_regular_file(unsaved, ignored)) window_frame_.workbench().offer_recovery(unsaved);
    }

    void run() {
        try {
            loop_.run([this](const app::Frame& frame) { return update(frame); },
                      [this](const app::Frame& frame) { draw(frame); });
        } catch (...) {
            rescue();
            throw;
        }
        autosave_.discard();
        store_layout();
        report("frames", loop_.times());
        report("frames of drags", drag_times_);
    }

 private:
    app::Next update(const app::Frame& frame) {
        gpu::require_context();
        if (dragged_) drag_times_.add(frame.elapsed);
        input_.begin_frame();
        for (const platform::InputEvent& event : frame.events) input_.apply(event);
        dragged_ = input_.mouse_button(platform::MouseButton::Left).down;
        for (const std::filesystem::path& file : frame.dropped) window_frame_.workbench().open(file);
        if (loop_.window().should_close()) {
            loop_.window().request_close(false);
            window_frame_.workbench().ask_to_close();
        }
        if (window_frame_.workbench().closed()) return app::Next::End;
        const bool results = session_.update();
        autosave();
        const bool used = frame.woken || !frame.dropped.empty() || input_.any_down() || frame.pixels != drawn_pixels_ ||
                          std::ranges::any_of(frame.events, is_of_user);
        return redraw_.next(used || results || session_.view.changes() || window_frame_.workbench().due(),
                            session_.busy(), Redraw::Clock::now());
    }

    void draw(const app::Frame& frame) {
        drawn_pixels_ = frame.pixels;
        window_frame_
            .draw(input_, true, {.size = frame.size, .framebuffer_size = frame.pixels, .seconds = frame.seconds()},
                  loop_.times().statistics().median_ms)
            .show_in_window();
    }

    void autosave() {
        session_.messages.attempt([&] {
            if (autosave_.update(session_.opened.document(), session_.opened.replacements(), Autosave::Clock::now()))
                store_layout();
        });
    }

    void rescue() {
        try {
            autosave_.write(session_.opened.document());
            store_layout();
            if (const auto& file = autosave_.file())
                log_warning("{}: holds the edits that were not saved", file->string());
        } catch (const std::exception& error) {
            log_warning("edits are lost: {}", error.what());
        }
    }

    static void report(const char* what, const platform::FrameTimes& times) {
        const platform::FrameStatistics statistics = times.statistics();
        log_info("the last {} {}: median {:.1f} ms, longest {:.1f} ms", statistics.count, what, statistics.median_ms,
                 statistics.maximum_ms);
    }

    void store_layout() {
        if (!layout_file_) return;
        layout_.width = loop_.window().size().x;
        layout_.height = loop_.window().size().y;
        layout_.stage = session_.view.stage;
        layout_.shape = preview_shape_name(session_.view.shape());
        layout_.unsaved = autosave_.file() ? std::filesystem::absolute(*autosave_.file()).string() : std::string();
        if (const auto light = session_.light.current())
            layout_.light = std::filesystem::absolute(light->path).string();
        try {
            save_layout(layout_, *layout_file_);
        } catch (const Error& error) {
            log_warning("{}", error.what());
        }
    }

    std::optional<std::filesystem::path> layout_file_;
    Layout layout_;
    app::WindowLoop loop_;
    Session session_;
    WindowFrame window_frame_;
    Autosave autosave_;
    platform::InputState input_;
    platform::FrameTimes drag_times_;  ///< with the mouse button down
    bool dragged_ = false;             ///< in the last frame
    glm::ivec2 drawn_pixels_{0};       ///< of the last frame
    Redraw redraw_;
};

int run(int argc, char** argv) try {
    const std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    const post::OcioConfig config = app::open_ocio_config(*options);
    if (options->capture) {
        capture(*options, config);
        return 0;
    }
    app::require_display("rowland-inspector", "write a picture with --capture FILE");
    const ThreadLimit one_core_for_frames(std::max(1U, std::thread::hardware_concurrency() - 1));
    Program(*options, config).run();
    return 0;
} catch (const Refused&) {
    return 2;
}

}  // namespace
}  // namespace rowland::inspector

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::inspector::run(argc, argv); });
}
