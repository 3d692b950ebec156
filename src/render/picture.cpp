#include "render/picture.h"

#include <cctype>

#include "core/error.h"
#include "core/file.h"

namespace shoal {

static std::string number(int frame, int digits) {
    std::string text = std::to_string(frame);
    if (int(text.size()) < digits) text.insert(0, size_t(digits) - text.size(), '0');
    return text;
}

// Replaces the one %d, %5d or %05d of a name. Not printf: the name comes from the user.
static std::string withNumber(const std::string& name, int frame) {
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
    return name.substr(0, percent) + number(frame, digits) + name.substr(end + 1);
}

std::filesystem::path frameFile(const std::string& target, int frame, bool many) {
    if (target.find('%') != std::string::npos) return withNumber(target, frame);
    const std::filesystem::path path(target);
    if (lowerExtension(path) != ".png") return path / ("frame-" + number(frame, 5) + ".png");
    if (!many) return path;
    return path.parent_path() / (path.stem().string() + "-" + number(frame, 5) + path.extension().string());
}

bool isVideo(const std::string& target) {
    const std::string extension = lowerExtension(target);
    return extension == ".mp4" || extension == ".mkv" || extension == ".webm" || extension == ".mov";
}

PictureWriter::PictureWriter(std::string target, double frameRate, bool many)
    : target_(std::move(target)), frameRate_(frameRate), many_(many) {
    if (isVideo(target_)) {
        VideoWriter::checkInstalled();
    } else {
        frameFile(target_, 0, many_);
    }
}

void PictureWriter::write(const Image& picture, int frame) {
    if (!isVideo(target_)) {
        last_ = frameFile(target_, frame, many_);
        writePng(last_, picture);
        return;
    }
    if (!video_) video_ = std::make_unique<VideoWriter>(target_, picture.width, picture.height, frameRate_);
    video_->write(picture);
    last_ = target_;
}

void PictureWriter::finish() {
    if (video_) video_->finish();
    video_.reset();
}

}  // namespace shoal
