#include "window/captures.h"

#include <iostream>

#include "core/image.h"
#include "core/printable.h"
#include "run/checkpoints.h"

namespace shoal::window {

void Captures::takePicture(RunningScene& running) {
    troubles_.attempt("capture", [&] {
        const std::string file = freeName(sceneStem(running.scene().file), ".png");
        writePng(file, running.renderer().capture());
        say("picture: " + file);
    });
}

void Captures::toggleVideo(RunningScene& running) {
    troubles_.attempt("recording", [&] {
        if (!recorder_.records())
            return recorder_.start(sceneStem(running.scene().file), running.scene().frameRate);
        recorder_.stop();
        say(concat("recorded: ", recorder_.target(), ", ", many(recorder_.frames(), "frame", "frames")));
    });
}

void Captures::endVideo(RunningScene& running) {
    if (recorder_.records()) toggleVideo(running);
}

void Captures::add(RunningScene& running) {
    if (!recorder_.records()) return;
    troubles_.attempt("recording", [&] { recorder_.add(running.renderer().capture()); });
}

void Captures::say(const std::string& line) {
    status_.say(line);
    std::cout << printable(line) << std::endl;
}

void Captures::drawLine() {
    status_.draw(recorder_.records() ? concat("Recording ", recorder_.target(), ", ",
                                              many(recorder_.frames(), "frame", "frames"), "; V stops")
                                     : std::string());
}

}  // namespace shoal::window
