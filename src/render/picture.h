// Where pictures go: a folder, a name with a number in it, or a video.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/image.h"
#include "core/part_file.h"
#include "render/video_writer.h"

namespace shoal {

// The file of one frame. `target` is a folder, which gets frame-00000.png and so on, or a name with one
// %d or %05d in it, or a name ending in .png, which takes the frame's number only if `many`. Numbers are as
// long as `last`, so that names sort. Error: more than one %, one that is no number, or one with too few
// digits.
std::filesystem::path frameFile(const std::string& target, int frame, bool many = true, int last = 99999);

// Whether `target` names a video: .mp4, .mkv, .webm or .mov.
bool isVideo(const std::string& target);

// Takes the pictures of a run, one a frame.
class PictureWriter {
  public:
    // `last`: the greatest frame number. Error: ffmpeg is needed and not installed, frameFile's, or
    // SoleWriter's.
    PictureWriter(std::string target, double frameRate, bool many = true, int last = 99999);

    // Error: disk full, no permission, ffmpeg failed, a video's pictures differ in size, or a frame of folder
    // or name is beyond the last.
    void write(const Image& picture, int frame);
    void finish();  // a video gets its name only now

    const std::string& target() const { return target_; }
    std::filesystem::path last() const { return last_; }  // written file; empty before the first

  private:
    std::string target_;
    double frameRate_;
    bool many_;
    int lastFrame_;
    std::optional<SoleWriter> sole_;
    std::unique_ptr<VideoWriter> video_;
    std::filesystem::path last_;
};

}  // namespace shoal
