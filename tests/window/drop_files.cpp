// drop_files WINDOW FILE...
// drop_files --die WINDOW
// drop_files --pixel WINDOW X Y
// The second exits in the middle of the drag, before the window can answer; the third prints what the screen shows. The
// first drops files onto the middle of an
// X11 window as a file manager does: an XDND source, version 5 [freedesktop.org, "Drag-and-Drop Protocol for the X
// Window System"].
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <poll.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

namespace {

constexpr long kVersion = 5;
constexpr int kPatience_ms = 20000;

class Source {
 public:
    Source(Display* display, Window target, std::string uris)
        : display_(display),
          target_(target),
          window_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)),
          uris_(std::move(uris)) {
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
    }

    void enter() {
        send("XdndEnter", {source(), kVersion << 24, static_cast<long>(atom("text/uri-list")), 0, 0});
        send("XdndPosition", {source(), 0, middle(), CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    }

    /// Whether the window took the files.
    bool drop() {
        enter();
        if ((wait_for("XdndStatus").data.l[1] & 1) == 0) return false;
        send("XdndDrop", {source(), 0, CurrentTime, 0, 0});
        return wait_for("XdndFinished").data.l[1] != 0;
    }

 private:
    Atom atom(const char* name) { return XInternAtom(display_, name, False); }
    long source() const { return static_cast<long>(window_); }

    /// The middle of the target on the screen, as the protocol packs it.
    long middle() {
        XWindowAttributes attributes;
        XGetWindowAttributes(display_, target_, &attributes);
        int x = 0;
        int y = 0;
        Window child = None;
        XTranslateCoordinates(display_, target_, attributes.root, attributes.width / 2, attributes.height / 2, &x, &y,
                              &child);
        return (static_cast<long>(x) << 16) | y;
    }

    void send(const char* message, const std::array<long, 5>& data) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i] = data[i];
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// Answers what the target asks for until it says `message`.
    XClientMessageEvent wait_for(const char* message) {
        for (;;) {
            pollfd ready{.fd = ConnectionNumber(display_), .events = POLLIN, .revents = 0};
            if (XPending(display_) == 0 && poll(&ready, 1, kPatience_ms) <= 0) {
                std::fprintf(stderr, "drop_files: the window never said %s\n", message);
                std::exit(1);
            }
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) hand_over(event.xselectionrequest);
            if (event.type == ClientMessage && event.xclient.message_type == atom(message)) return event.xclient;
        }
    }

    void hand_over(const XSelectionRequestEvent& asked) {
        XChangeProperty(display_, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uris_.data()), static_cast<int>(uris_.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = asked.requestor;
        event.xselection.selection = asked.selection;
        event.xselection.target = asked.target;
        event.xselection.property = asked.property;
        event.xselection.time = asked.time;
        XSendEvent(display_, asked.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    Display* display_;
    Window target_;
    Window window_;
    std::string uris_;
};

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::fprintf(stderr, "usage: drop_files WINDOW FILE... | --die WINDOW | --pixel WINDOW X Y\n");
        return 2;
    }
    const bool dies = arguments[1] == std::string("--die");
    const bool looks = count == 5 && arguments[1] == std::string("--pixel");
    std::string uris;
    for (int i = 2; i < count; ++i) uris += "file://" + std::filesystem::absolute(arguments[i]).string() + "\r\n";
    const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(nullptr), XCloseDisplay);
    if (!display) {
        std::fprintf(stderr, "drop_files: no display\n");
        return 1;
    }
    if (looks) {
        XImage* image = XGetImage(display.get(), std::strtoul(arguments[2], nullptr, 0), std::atoi(arguments[3]),
                                  std::atoi(arguments[4]), 1, 1, AllPlanes, ZPixmap);
        std::printf("%06lx", XGetPixel(image, 0, 0) & 0xffffff);
        XDestroyImage(image);
        return 0;
    }
    Source source(display.get(), std::strtoul(arguments[dies ? 2 : 1], nullptr, 0), uris);
    if (!dies) return source.drop() ? 0 : 1;
    // No other client is served before the server has removed what this one leaves.
    XGrabServer(display.get());
    source.enter();
    XSync(display.get(), False);
    return 0;
}
