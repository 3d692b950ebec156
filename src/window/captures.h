// Pictures and videos that the user takes of a scene in the window, without the panels, and the line at the
// bottom that tells of them.
#pragma once

#include <string>

#include "render/picture.h"
#include "window/notices.h"
#include "window/running_scene.h"

namespace shoal::window {

class Captures {
  public:
    // What fails is one of the troubles.
    explicit Captures(Troubles& troubles) : troubles_(troubles) {}

    void takePicture(RunningScene& running);
    // Begins a video, or ends it.
    void toggleVideo(RunningScene& running);
    void endVideo(RunningScene& running);  // if there is one
    bool records() const { return recorder_.records(); }
    // A frame that was simulated and drawn, into the video, if there is one.
    void add(RunningScene& running);

    void say(const std::string& line);  // also on standard output
    void drawLine();

  private:
    Troubles& troubles_;
    Recorder recorder_;
    StatusLine status_;
};

}  // namespace shoal::window
