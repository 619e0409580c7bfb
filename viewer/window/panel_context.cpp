#include "viewer/window/panel_context.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

constexpr std::pair<ImGuiKey_, Key> editing_keys[] = {{ImGuiKey_Tab, Key::tab},
                                                      {ImGuiKey_LeftArrow, Key::left},
                                                      {ImGuiKey_RightArrow, Key::right},
                                                      {ImGuiKey_UpArrow, Key::up},
                                                      {ImGuiKey_DownArrow, Key::down},
                                                      {ImGuiKey_Home, Key::home},
                                                      {ImGuiKey_End, Key::end},
                                                      {ImGuiKey_Delete, Key::remove},
                                                      {ImGuiKey_Backspace, Key::backspace},
                                                      {ImGuiKey_Space, Key::space},
                                                      {ImGuiKey_Enter, Key::enter},
                                                      {ImGuiKey_Escape, Key::escape},
                                                      {ImGuiKey_A, Key::a},
                                                      {ImGuiKey_C, Key::c},
                                                      {ImGuiKey_V, Key::v},
                                                      {ImGuiKey_X, Key::x},
                                                      {ImGuiKey_Y, Key::y},
                                                      {ImGuiKey_Z, Key::z}};

}  // namespace

PanelContext::PanelContext(double scale) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // we leave no files behind
    for (const auto& [panel_key, key] : editing_keys)
        io.KeyMap[panel_key] = static_cast<int>(key);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(static_cast<float>(scale));
    ImFontConfig font;
    font.SizePixels = std::round(static_cast<float>(13 * scale));
    io.Fonts->AddFontDefault(&font);
    if (!ImGui_ImplOpenGL3_Init("#version 330")) {
        ImGui::DestroyContext();
        throw SystemError("OpenGL cannot draw the panel");
    }
}

PanelContext::~PanelContext() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

PanelClaims PanelContext::begin(const InputFrame& frame, int width, int height) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
    constexpr float least_seconds = 1e-4F;
    io.DeltaTime = std::max(least_seconds, static_cast<float>(frame.seconds));
    // What goes down and up within one frame must be seen down once.
    std::array<bool, 3> button_pressed = {};
    std::array<bool, key_count> key_pressed = {};
    for (const Input& input : frame.inputs) {
        if (const auto* key = std::get_if<KeyInput>(&input)) {
            key_held_[static_cast<std::size_t>(key->key)] = key->down;
            if (key->down) key_pressed[static_cast<std::size_t>(key->key)] = true;
        } else if (const auto* text = std::get_if<TextInput>(&input)) {
            io.AddInputCharacter(static_cast<unsigned>(text->character));
        } else if (const auto* button = std::get_if<ButtonInput>(&input)) {
            button_held_[static_cast<std::size_t>(button->button)] = button->down;
            if (button->down) button_pressed[static_cast<std::size_t>(button->button)] = true;
        } else if (const auto* cursor = std::get_if<CursorInput>(&input)) {
            io.MousePos = ImVec2(static_cast<float>(cursor->position[0]),
                                 static_cast<float>(cursor->position[1]));
        } else if (const auto* wheel = std::get_if<WheelInput>(&input)) {
            io.MouseWheel += static_cast<float>(wheel->notches);
        } else if (std::holds_alternative<FocusLost>(input)) {
            button_held_.fill(false);
            key_held_.fill(false);
        }
    }
    for (std::size_t k = 0; k < button_held_.size(); ++k)
        io.MouseDown[k] = button_held_[k] || button_pressed[k];
    for (std::size_t k = 0; k < key_count; ++k)
        io.KeysDown[k] = key_held_[k] || key_pressed[k];
    const auto held = [this](Key key) { return key_held_[static_cast<std::size_t>(key)]; };
    io.KeyCtrl = held(Key::control);
    io.KeyShift = held(Key::shift);
    io.KeyAlt = held(Key::alt);

    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    return {io.WantCaptureMouse, io.WantTextInput};
}

void PanelContext::draw() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace lightwell
