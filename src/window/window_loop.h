// The loop of every window: frame by frame what the user did, the picture, the panels over it and the screen,
// until the window closes. What is shown, and what is done about it, is a class of its own (viewer.cpp,
// editor/editor_window.cpp).
#pragma once

#include <string>

#include "gpu/context.h"
#include "window/interface.h"
#include "window/notices.h"
#include "window/windows.h"

namespace shoal::window {

class WindowLoop {
  public:
    // `context` has a window.
    WindowLoop(WindowOptions options, gpu::Context& context);
    virtual ~WindowLoop() = default;
    WindowLoop(const WindowLoop&) = delete;
    WindowLoop& operator=(const WindowLoop&) = delete;

    void go();  // until the window closes

  protected:
    // ---- A frame, in this order

    virtual void drawPicture() = 0;
    virtual void drawInterface() = 0;  // over the picture; what the user did is in keys() and ImGui
    virtual void obey() = 0;           // does what was asked for, after the frame is on the screen
    // Whether nothing moves: then frames come when the user does something, and now and then.
    virtual bool rests() { return false; }

    // Whether the window may close, which the user asks for. False: it stays, and something is to be said
    // first.
    virtual bool mayClose() = 0;

    // ---- For those

    gpu::Context& context() { return context_; }
    Input& keys() { return interface_.input(); }
    double pixelsPerPoint() const { return interface_.pixelsPerPoint(); }
    int width() const { return width_; }                   // pixels
    int height() const { return height_; }                 // pixels
    int shown() const { return shown_; }                   // frames
    double lastSeconds() const { return lastSeconds_; }    // wall clock, of the last frame
    double frameSeconds() const { return frameSeconds_; }  // smoothed; 0: not known yet
    bool savesScreenshot() const { return saves_; }        // of this frame
    static double wallTime();                              // s

    void close();                                         // after this frame, where mayClose() agrees
    void entitle(const std::string& file, bool unsaved);  // by the name of a file, which may lie in a folder

    Troubles troubles;

  private:
    bool ends();
    bool showFrame();
    void saveScreenshot() const;

    WindowOptions options_;
    gpu::Context& context_;
    GLFWwindow* window_;
    Interface interface_;
    int width_ = 0, height_ = 0, shown_ = 0;
    bool saves_ = false;
    double lastSeconds_ = 0, frameSeconds_ = 0;
};

}  // namespace shoal::window
