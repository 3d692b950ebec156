// Pictures and videos that the user asks for while the scene runs: beside one another in the working folder,
// numbered, over no file that is there.
#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "render/picture.h"

namespace shoal::window {

// "leaves-001.png", or with the first number for which there is no such file or folder.
std::string freeName(const std::string& stem, const std::string& ending);

class Recorder {
  public:
    // A video where ffmpeg is installed, else a folder of pictures. Error: cannot be made.
    void start(const std::string& stem, double frameRate);
    void add(const Image& picture);  // Error: PictureWriter's, and it records no more
    void stop();                     // Error: the same
    bool records() const { return writer_ != nullptr; }
    int frames() const { return frames_; }
    const std::string& target() const { return target_; }  // of the last start

  private:
    std::unique_ptr<PictureWriter> writer_;  // null: nothing is recorded
    std::string target_;
    int frames_ = 0;
};

}  // namespace shoal::window
