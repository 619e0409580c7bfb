#pragma once

#include "viewer/window/gestures.h"
#include "viewer/window/lit_scene.h"
#include "viewer/window/loading.h"
#include "viewer/window/probe_reader.h"
#include "viewer/window/stage_times.h"
#include "viewer/window/visit.h"

namespace lightwell {

/// What the panel shows, and what it may change: the visit.
struct PanelSubject {
    Visit& visit;
    const LitScene* scene;  ///< null while the first one is on its way
    const ProbeReader& probe;
    const StageHistory& history;
    const LoadingState* loading;  ///< null when nothing is on its way
    Handle handle;                ///< under the cursor, or in the hand
    int width, height;            ///< of the picture [pixels], which is left of the panel
};

/// Width of the panel with its margin [pixels]. Valid within a frame.
int panel_width();

// All of these draw with ImGui, within a frame.

/// The panel and everything on it.
void show_panel(const PanelSubject& subject);
/// Lamps and their handles, the probe, legends, over the picture.
void show_overlay(const PanelSubject& subject);
/// What is on its way, in the middle of the window while there is no scene, else at its foot.
void show_loading(const PanelSubject& subject);
/// What keys and mouse do.
void show_help(const PanelSubject& subject);

// Sections of the panel.
void show_lights(const PanelSubject& subject);
void show_pictures(const PanelSubject& subject);
void show_probe(const PanelSubject& subject);
void show_times(const PanelSubject& subject);
void show_walk(Visit& visit);
void show_files(const PanelSubject& subject);

}  // namespace lightwell
