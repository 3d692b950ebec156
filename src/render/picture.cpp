#include "render/picture.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/error.h"
#include "core/file.h"

namespace shoal {

void turnOver(Image& image) {
    const auto row = std::ptrdiff_t(image.width) * image.channels;
    for (auto top = image.pixels.begin(), end = image.pixels.end(); end - top > row; top += row, end -= row)
        std::swap_ranges(top, top + row, end - row);
}

static std::string number(int frame, int digits) {
    std::string text = std::to_string(frame);
    if (int(text.size()) < digits) text.insert(0, size_t(digits) - text.size(), '0');
    return text;
}

// Replaces the one %d, %5d or %05d of a name. Not printf: the name comes from the user.
static std::string withNumber(const std::string& name, int frame, int last) {
    const size_t percent = name.find('%');
    size_t end = percent + 1;
    int digits = 0;
    while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end])) && digits < 100)
        digits = digits * 10 + (name[end++] - '0');
    const bool sound =
        end < name.size() && name[end] == 'd' && digits <= 20 && name.find('%', end) == std::string::npos;
    if (!sound)
        throw Error(
            concat("expected one frame number such as %05d in the name of a picture, found \"", name, "\""));
    const auto needed = std::to_string(last).size();
    if (digits > 0 && size_t(digits) < needed)
        throw Error(concat("\"", name, "\" has ", digits,
                           " digits for a frame's number, and the last frame, ", last, ", has ", needed,
                           ": the names would not sort; say %0", needed, "d"));
    return name.substr(0, percent) + number(frame, digits) + name.substr(end + 1);
}

static bool isPicture(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".png" || extension == ".exr";
}

std::filesystem::path frameFile(const std::string& target, int frame, bool many, int last) {
    if (target.find('%') != std::string::npos) return withNumber(target, frame, last);
    std::filesystem::path path(target);
    const std::string padded = number(frame, std::max(5, int(std::to_string(last).size())));
    if (!isPicture(path)) return path / ("frame-" + padded + ".png");
    if (!many) return path;
    return path.parent_path() / (path.stem().string() + "-" + padded + path.extension().string());
}

bool isVideo(const std::string& target) {
    const std::string extension = lowerExtension(target);
    return extension == ".mp4" || extension == ".mkv" || extension == ".webm" || extension == ".mov";
}

bool isVideoWithAlpha(const std::string& target) {
    const std::string extension = lowerExtension(target);
    return extension == ".webm" || extension == ".mov";
}

PictureWriter::PictureWriter(std::string target, double frameRate, bool many, int last, bool alpha)
    : target_(std::move(target)), frameRate_(frameRate), many_(many), alpha_(alpha), lastFrame_(last) {
    if (isVideo(target_)) {
        VideoWriter::checkInstalled();
        PartFile{target_};  // can be written
    } else {
        frameFile(target_, 0, many_, lastFrame_);
    }
    const std::filesystem::path path(target_);
    if (!isVideo(target_) && target_.find('%') == std::string::npos && !isPicture(path))
        sole_.emplace(path / "frame.png");
    else if (path.parent_path().string().find('%') == std::string::npos)  // else a folder a frame
        sole_.emplace(path);
}

void PictureWriter::write(Image picture, int frame) {
    if (!isVideo(target_)) {
        const std::filesystem::path file = place(frame);
        if (writing_.valid()) writing_.get();
        writing_ =
            std::async(std::launch::async, [file, picture = std::move(picture)] { writePng(file, picture); });
        return;
    }
    if (!video_)
        video_ = std::make_unique<VideoWriter>(target_, picture.width, picture.height, frameRate_, alpha_);
    video_->write(picture);
    last_ = target_;
}

std::filesystem::path PictureWriter::place(int frame) {
    if (frame > lastFrame_)
        throw Error(concat(target_, ": frame ", frame, " is beyond the last that names have digits for"));
    last_ = frameFile(target_, frame, many_, lastFrame_);
    return last_;
}

void PictureWriter::finish() {
    if (writing_.valid()) writing_.get();
    if (video_) video_->finish();
    video_.reset();
    sole_.reset();
}

// ---- What the user asks for while the scene runs

std::string freeName(const std::string& stem, const std::string& ending) {
    constexpr int most = 100000;
    for (int i = 1; i < most; ++i) {
        std::string name = concat(stem, "-", number(i, 3), ending);
        std::error_code code;
        if (!std::filesystem::exists(std::filesystem::symlink_status(name, code))) return name;
    }
    throw Error(concat(stem, ending, ": there are too many already"));
}

void Recorder::start(const std::string& stem, double frameRate) {
    target_ = freeName(stem, VideoWriter::installed() ? ".mp4" : "");
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

}  // namespace shoal
