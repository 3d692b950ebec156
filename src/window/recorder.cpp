#include "window/recorder.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "render/video_writer.h"

namespace shoal::window {

std::string freeName(const std::string& stem, const std::string& ending) {
    constexpr int most = 100000;
    for (int i = 1; i < most; ++i) {
        char number[16];
        std::snprintf(number, sizeof number, "-%03d", i);
        std::string name = stem + number + ending;
        std::error_code code;
        if (!std::filesystem::exists(std::filesystem::symlink_status(name, code))) return name;
    }
    throw Error(concat(stem, ending, ": there are too many already"));
}

static bool hasFfmpeg() {
    try {
        VideoWriter::checkInstalled();
        return true;
    } catch (const Error&) {
        return false;
    }
}

void Recorder::start(const std::string& stem, double frameRate) {
    target_ = freeName(stem, hasFfmpeg() ? ".mp4" : "");
    frames_ = 0;
    constexpr int most = 9'999'999;  // pictures: nobody knows yet when it stops
    writer_ = std::make_unique<PictureWriter>(target_, frameRate, true, most);
}

void Recorder::add(const Image& picture) {
    try {
        writer_->write(picture, frames_++);
    } catch (const Error&) {
        writer_.reset();
        throw;
    }
}

void Recorder::stop() {
    const std::unique_ptr<PictureWriter> writer = std::move(writer_);
    if (writer) writer->finish();
}

}  // namespace shoal::window
