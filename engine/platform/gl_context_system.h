#pragma once

#include <memory>
#include <string>
#include <vector>

// How the operating system makes OpenGL contexts without a window: gl_context_egl.cpp, gl_context_wgl.cpp.
namespace rowland::platform {

/// An OpenGL 4.5 core context.
class SystemContext {
 public:
    virtual ~SystemContext() = default;
    /// False if the context cannot be made current on this thread.
    virtual bool make_current() = 0;
};

/// Where a context can be had: a GPU, a driver.
class ContextSource {
 public:
    virtual ~ContextSource() = default;
    /// A context, or null with the reason. `debug`: a debug context.
    virtual std::unique_ptr<SystemContext> create(bool debug, std::string& reason) = 0;
    virtual std::string kind() const = 0;      ///< as "EGL device", for lists of GPUs
    virtual std::string pci_slot() const = 0;  ///< as in GpuName
};

/// All sources, hardware first. If there is none, `reason` says why; it is what was looked for otherwise.
std::vector<std::unique_ptr<ContextSource>> context_sources(std::string& reason);

/// What the user can do if no source gives a context, and what the sources need.
extern const char* const context_remedy;
extern const char* const context_needs;

}  // namespace rowland::platform
