// The loop of every window: frame by frame what the user did, the picture, the panels over it and the screen,
// until the window closes. What is shown, and what is done about it, is a class of its own (viewer.cpp,
// editor/editor_window.cpp).
//
// There are two threads and two contexts. The main thread has the window's: it takes events, shows the
// picture and draws the panels. All the rest is done by the other, which alone uses the context of the scene.
// While that is busy, mostly because a driver compiles, the window goes on, shows the last picture, and says
// what it waits for.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gpu/context.h"
#include "gpu/texture.h"
#include "run/progress.h"
#include "window/context_thread.h"
#include "window/interface.h"
#include "window/notices.h"
#include "window/windows.h"

namespace shoal::window {

class WindowLoop {
  public:
    // `context` is a window's and current, and so it is again after go().
    WindowLoop(WindowOptions options, gpu::Context& context);
    virtual ~WindowLoop();
    WindowLoop(const WindowLoop&) = delete;
    WindowLoop& operator=(const WindowLoop&) = delete;

    void go();  // until the window closes

  protected:
    // ---- A frame, in this order, in the context of the scene

    virtual void drawPicture() = 0;    // and show() it
    virtual void drawInterface() = 0;  // over the picture; what the user did is in keys() and ImGui
    virtual void obey() = 0;           // does what was asked for, after the frame is on the screen
    virtual void leave() {}            // after the last frame
    // Whether nothing moves: then frames come when the user does something, and now and then.
    virtual bool rests() { return false; }
    // Steps a second of what moves, which is no faster however fast the screen is; 0: nothing moves.
    virtual double moves() { return 0; }

    // Whether the window may close, which the user asks for. False: it stays, and something is to be said
    // first.
    virtual bool mayClose() = 0;

    // ---- For those

    gpu::Context& context() { return context_; }
    void show(const gpu::Texture& picture);  // from this frame on, until another one is shown
    Input& keys() { return interface_->input(); }
    double pixelsPerPoint() const { return interface_->pixelsPerPoint(); }
    int width() const { return width_; }    // pixels
    int height() const { return height_; }  // pixels
    int shown() const { return shown_; }    // frames
    double lastSeconds() const {
        return lastSeconds_;
    }              // wall clock, of the last frame without waits for its time
    bool isDue();  // the next step of what moves; the one after it is later
    double frameSeconds() const { return frameSeconds_; }  // smoothed; 0: not known yet
    bool savesScreenshot() const { return saves_; }        // of this frame
    static double wallTime();                              // s

    void close() { closes_ = true; }                      // after this frame, where mayClose() agrees
    void entitle(const std::string& file, bool unsaved);  // by the name of a file, which may lie in a folder

    Troubles troubles;

  private:
    bool ends();
    void awaitFrame();
    bool showFrame();
    void work(std::function<void()> part);
    void tellWaiting(const Busy& busy);
    void takePicture();
    void presentPicture(int width, int height);
    void saveScreenshot() const;

    struct Picture {
        unsigned texture = 0;  // 0: it was taken
        int width = 0, height = 0;
        GLsync drawn = nullptr;
    };

    WindowOptions options_;
    gpu::Context& context_;
    GLFWwindow* window_;
    std::optional<Interface> interface_;
    ContextThread* thread_ = nullptr;         // while the loop goes on
    GLsync presented_ = nullptr;              // after which another picture may be drawn
    Picture drawn_;                           // by the thread of the scene
    unsigned source_ = 0;                     // the window's framebuffer that holds the picture
    int sourceWidth_ = 0, sourceHeight_ = 0;  // pixels; 0: there is no picture yet
    bool closes_ = false;                     // after this frame
    std::string title_;                       // not set yet
    int width_ = 0, height_ = 0, shown_ = 0;
    bool saves_ = false;
    double lastSeconds_ = 0, frameSeconds_ = 0;
    double next_ = 0, waited_ = 0;  // s: when the next step is due, by wallTime(); before the last frame
};

}  // namespace shoal::window
