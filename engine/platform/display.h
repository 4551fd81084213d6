#pragma once

// What windows need to know of the display: display_posix.cpp, display_windows.cpp.
namespace rowland::platform {

/// Whether the environment announces a display. False: none needs to be tried.
bool display_announced();

/// Xlib's own handler of errors ends the program, for example if the source of a drag exits before GLFW answers it.
/// GLFW 3.3 restores that handler whenever it makes a window, so call this afterwards. Does nothing where GLFW does not
/// use X.
void survive_display_errors();

}  // namespace rowland::platform
