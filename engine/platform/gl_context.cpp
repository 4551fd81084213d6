#include "engine/platform/gl_context.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/system.h"
#include "engine/gpu/context.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/platform/gl_context_system.h"

namespace rowland::platform {

bool debug_build() {
#ifdef NDEBUG
    return false;
#else
    return true;
#endif
}

std::string wanted_gpu(const std::string& option) {
    return option.empty() ? environment_variable(gpu_variable).value_or("") : option;
}

std::vector<std::pair<std::string, std::string>> offload_variables(const GpuName& gpu) {
    if (gpu::is_software_renderer(gpu.renderer))
        return {{"LIBGL_ALWAYS_SOFTWARE", "1"}, {"__GLX_VENDOR_LIBRARY_NAME", "mesa"}};
    if (gpu.vendor == "NVIDIA Corporation")
        return {{"__NV_PRIME_RENDER_OFFLOAD", "1"}, {"__GLX_VENDOR_LIBRARY_NAME", "nvidia"}};
    if (gpu.pci_slot.empty()) return {};
    std::string slot = gpu.pci_slot;
    std::ranges::replace_if(
        slot, [](char c) { return c == ':' || c == '.'; }, '_');
    return {{"DRI_PRIME", "pci-" + slot}};
}

std::string choose_gpu_of_windows(const std::string& option) {
    if (wanted_gpu(option).empty()) return {};
    const HeadlessContext chosen({.debug = false, .gpu = option});
    for (const auto& [name, value] : offload_variables(chosen.name())) set_default_variable(name, value);
    return chosen.renderer();
}

void require_gpu_of_window(const std::string& chosen) {
    const std::string found = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (chosen.empty() || found == chosen) return;
    fail_system(gpu_variable, fmt::format("a display whose windows draw on \"{}\"", found),
                "set DRI_PRIME=1 (Mesa), or __NV_PRIME_RENDER_OFFLOAD=1 and __GLX_VENDOR_LIBRARY_NAME=nvidia (NVIDIA); "
                "or make no choice",
                fmt::format("\"{}\", which was chosen", chosen));
}

namespace {

[[noreturn]] void fail(std::string found, std::string remedy = "") {
    fail_system("OpenGL without a window", std::move(found), std::move(remedy), context_needs);
}

/// Whether `wanted` is the number or, ignoring case, a part of the name.
bool is_wanted(std::string_view wanted, std::size_t number, std::string_view name) {
    if (wanted == std::to_string(number)) return true;
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return wanted.find_first_not_of("0123456789") != std::string_view::npos &&
           !std::ranges::search(name, wanted, {}, lower, lower).empty();
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

}  // namespace

struct HeadlessContext::State {
    std::unique_ptr<SystemContext> context;
    GpuName name;
    std::string version;
};

HeadlessContext::HeadlessContext(const HeadlessOptions& options) {
    const std::string wanted = wanted_gpu(options.gpu);
    std::string reason;
    std::vector<std::string> others;
    for (const std::unique_ptr<ContextSource>& source : context_sources(reason)) {
        state_ = std::make_unique<State>();
        state_->context = source->create(options.debug, reason);
        if (!state_->context) continue;
        make_current();
        state_->name = {gl_string(GL_RENDERER), gl_string(GL_VENDOR), source->pci_slot()};
        state_->version = gl_string(GL_VERSION);
        const std::string name = fmt::format("{}, {}", renderer(), source->kind());
        if (wanted.empty() || is_wanted(wanted, others.size(), name)) return;
        others.push_back(fmt::format("{} = {}", others.size(), name));
    }
    if (others.empty()) fail(reason, context_remedy);
    refuse_input(gpu_variable, "", fmt::format("no GPU \"{}\"", wanted),
                 fmt::format("the number or a part of the name of one of: {}", fmt::join(others, "; ")));
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_current() {
    if (!state_->context->make_current())
        fail("a context that cannot be made current on this thread", "it may still be current on another thread");
    gpu::forget_bound_state();
}

const GpuName& HeadlessContext::name() const {
    return state_->name;
}

const std::string& HeadlessContext::renderer() const {
    return state_->name.renderer;
}

const std::string& HeadlessContext::version() const {
    return state_->version;
}

bool HeadlessContext::is_software() const {
    return gpu::is_software_renderer(renderer());
}

}  // namespace rowland::platform
