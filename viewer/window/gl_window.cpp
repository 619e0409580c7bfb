#include "viewer/window/gl_window.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

constexpr std::pair<int, Key> named_keys[] = {{GLFW_KEY_MINUS, Key::minus},
                                              {GLFW_KEY_KP_SUBTRACT, Key::minus},
                                              {GLFW_KEY_PERIOD, Key::period},
                                              {GLFW_KEY_KP_DECIMAL, Key::period},
                                              {GLFW_KEY_SPACE, Key::space},
                                              {GLFW_KEY_TAB, Key::tab},
                                              {GLFW_KEY_ENTER, Key::enter},
                                              {GLFW_KEY_KP_ENTER, Key::enter},
                                              {GLFW_KEY_ESCAPE, Key::escape},
                                              {GLFW_KEY_BACKSPACE, Key::backspace},
                                              {GLFW_KEY_DELETE, Key::remove},
                                              {GLFW_KEY_HOME, Key::home},
                                              {GLFW_KEY_END, Key::end},
                                              {GLFW_KEY_LEFT, Key::left},
                                              {GLFW_KEY_RIGHT, Key::right},
                                              {GLFW_KEY_UP, Key::up},
                                              {GLFW_KEY_DOWN, Key::down},
                                              {GLFW_KEY_LEFT_SHIFT, Key::shift},
                                              {GLFW_KEY_RIGHT_SHIFT, Key::shift},
                                              {GLFW_KEY_LEFT_CONTROL, Key::control},
                                              {GLFW_KEY_RIGHT_CONTROL, Key::control},
                                              {GLFW_KEY_LEFT_ALT, Key::alt},
                                              {GLFW_KEY_F1, Key::f1},
                                              {GLFW_KEY_F5, Key::f5},
                                              {GLFW_KEY_F12, Key::f12}};

Key shifted(Key first, int by) {
    return static_cast<Key>(static_cast<int>(first) + by);
}

Key key_of(int glfw_key, int scancode) {
    if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9)
        return shifted(Key::digit_0, glfw_key - GLFW_KEY_0);
    if (glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_9)
        return shifted(Key::digit_0, glfw_key - GLFW_KEY_KP_0);
    for (const auto& [number, key] : named_keys)
        if (glfw_key == number) return key;
    // Letters by what is printed on them, for Ctrl+Z; walking is by place on the keyboard, but
    // the two differ on few of them, and a help that names other letters helps nobody.
    const char* const printed = glfwGetKeyName(glfw_key, scancode);
    const char letter = printed && printed[1] == '\0' ? printed[0] : '\0';
    if (letter >= 'a' && letter <= 'z') return shifted(Key::a, letter - 'a');
    if (glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z)
        return shifted(Key::a, glfw_key - GLFW_KEY_A);
    return Key::unknown;
}

/// What GLFW last complained of, as it tells it.
std::string last_complaint() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW does not say why";
}

/// GLFW, from first to last use.
struct Desktop {
    Desktop() {
        glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
        if (!glfwInit())
            throw SystemError("there is no display to open a window on: " + last_complaint());
    }
    ~Desktop() { glfwTerminate(); }
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;
};

}  // namespace

struct GlWindow::State {
    Desktop desktop;
    GLFWwindow* window = nullptr;
    std::vector<Input> inputs;

    State(const std::string& title, int width, int height) {
        const GlVersion least;
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, least.major);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, least.minor);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (!window)
            throw SystemError(fmt::format("no window with OpenGL {}.{} can be opened here: {}",
                                          least.major, least.minor, last_complaint()));
    }
    ~State() { glfwDestroyWindow(window); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// Screen coordinates, which GLFW tells cursors in, to pixels.
    Vec2 pixels(double x, double y) const {
        int width = 1, height = 1, columns = 1, rows = 1;
        glfwGetWindowSize(window, &width, &height);
        glfwGetFramebufferSize(window, &columns, &rows);
        return {width > 0 ? x * columns / width : x, height > 0 ? y * rows / height : y};
    }
};

struct GlWindow::Callbacks {
    static State& of(GLFWwindow* window) {
        return *static_cast<State*>(glfwGetWindowUserPointer(window));
    }
    static void key(GLFWwindow* window, int key, int scancode, int action, int) {
        if (action == GLFW_REPEAT) return;
        of(window).inputs.emplace_back(KeyInput{key_of(key, scancode), action == GLFW_PRESS});
    }
    static void text(GLFWwindow* window, unsigned character) {
        of(window).inputs.emplace_back(TextInput{static_cast<char32_t>(character)});
    }
    static void button(GLFWwindow* window, int button, int action, int) {
        if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
        of(window).inputs.emplace_back(
            ButtonInput{static_cast<MouseButton>(button), action == GLFW_PRESS});
    }
    static void cursor(GLFWwindow* window, double x, double y) {
        of(window).inputs.emplace_back(CursorInput{of(window).pixels(x, y)});
    }
    static void wheel(GLFWwindow* window, double, double notches) {
        of(window).inputs.emplace_back(WheelInput{notches});
    }
    static void size(GLFWwindow* window, int width, int height) {
        // A window put away has no content.
        if (width > 0 && height > 0) of(window).inputs.emplace_back(SizeInput{width, height});
    }
    static void drop(GLFWwindow* window, int count, const char** paths) {
        for (int k = 0; k < count; ++k)
            of(window).inputs.emplace_back(DropInput{paths[k]});
    }
    static void focus(GLFWwindow* window, int focused) {
        if (!focused) of(window).inputs.emplace_back(FocusLost{});
    }
};

GlWindow::GlWindow(const std::string& title, int width, int height)
    : state_(std::make_unique<State>(title, width, height)) {
    static_assert(GLFW_MOUSE_BUTTON_LEFT == static_cast<int>(MouseButton::left) &&
                  GLFW_MOUSE_BUTTON_RIGHT == static_cast<int>(MouseButton::right) &&
                  GLFW_MOUSE_BUTTON_MIDDLE == static_cast<int>(MouseButton::middle));
    GLFWwindow* const window = state_->window;
    glfwSetWindowUserPointer(window, state_.get());
    glfwSetKeyCallback(window, Callbacks::key);
    glfwSetCharCallback(window, Callbacks::text);
    glfwSetMouseButtonCallback(window, Callbacks::button);
    glfwSetCursorPosCallback(window, Callbacks::cursor);
    glfwSetScrollCallback(window, Callbacks::wheel);
    glfwSetFramebufferSizeCallback(window, Callbacks::size);
    glfwSetDropCallback(window, Callbacks::drop);
    glfwSetWindowFocusCallback(window, Callbacks::focus);
    make_current();
    glfwSwapInterval(1);
}

GlWindow::~GlWindow() = default;

void GlWindow::make_current() {
    glfwMakeContextCurrent(state_->window);
    if (glfwGetCurrentContext() != state_->window)
        throw SystemError("the window's OpenGL context cannot be used: " + last_complaint());
}

GlFunction GlWindow::function(const char* name) const {
    return glfwGetProcAddress(name);
}

std::string GlWindow::description() const {
    constexpr unsigned version = 0x1f02, renderer = 0x1f01;  // GL_VERSION, GL_RENDERER
    const auto get_string =
        reinterpret_cast<const unsigned char* (*)(unsigned)>(function("glGetString"));
    const auto text = [&](unsigned name) {
        const unsigned char* const found = get_string ? get_string(name) : nullptr;
        return std::string(found ? reinterpret_cast<const char*>(found) : "unknown");
    };
    return fmt::format("OpenGL {}, {}", text(version), text(renderer));
}

std::vector<Input> GlWindow::inputs(double patience) {
    if (patience > 0)
        glfwWaitEventsTimeout(patience);
    else
        glfwPollEvents();
    return std::exchange(state_->inputs, {});
}

void GlWindow::show() {
    glfwSwapBuffers(state_->window);
}

bool GlWindow::is_closed() const {
    return glfwWindowShouldClose(state_->window) != 0;
}

SizeInput GlWindow::size() const {
    SizeInput size;
    glfwGetFramebufferSize(state_->window, &size.width, &size.height);
    return size;
}

void GlWindow::resize(const SizeInput& size) {
    glfwSetWindowSize(state_->window, size.width, size.height);
}

double GlWindow::scale() const {
    float across = 1, down = 1;
    glfwGetWindowContentScale(state_->window, &across, &down);
    return static_cast<double>(down);
}

void GlWindow::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void GlWindow::capture_cursor(bool captured) {
    glfwSetInputMode(state_->window, GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported())
        glfwSetInputMode(state_->window, GLFW_RAW_MOUSE_MOTION, captured);
}

}  // namespace lightwell
