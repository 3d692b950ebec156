#include "window/window_loop.h"

#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <utility>

#include "core/printable.h"
#include "gpu/gl.h"
#include "render/picture.h"
#include "run/signals.h"

namespace shoal::window {

WindowLoop::WindowLoop(WindowOptions options, gpu::Context& context)
    : options_(std::move(options)),
      context_(context),
      window_(context.window()),
      interface_(window_, options_.scale) {
    glfwSwapInterval(1);
    glfwGetFramebufferSize(window_, &width_, &height_);
}

void WindowLoop::go() {
    auto last = std::chrono::steady_clock::now();
    while (!ends()) {
        constexpr double pause = 0.05;  // s
        if (rests() && !interface_.input().waits())
            glfwWaitEventsTimeout(pause);
        else
            glfwPollEvents();
        const auto time = std::chrono::steady_clock::now();
        lastSeconds_ = std::chrono::duration<double>(time - last).count();
        last = time;
        // the first intervals hold start-up, not frames
        if (shown_ > 1) frameSeconds_ += (lastSeconds_ - frameSeconds_) * (shown_ == 2 ? 1 : 0.1);
        if (!showFrame()) break;
    }
}

bool WindowLoop::ends() {
    if (signalThatAsked()) return true;
    if (!glfwWindowShouldClose(window_)) return false;
    if (saves_) return true;
    if (mayClose()) {
        saves_ = !options_.screenshot.empty();  // of one more frame
        return !saves_;
    }
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return false;
}

// False after the last that was asked for.
bool WindowLoop::showFrame() {
    glfwGetFramebufferSize(window_, &width_, &height_);
    if (width_ < 1 || height_ < 1) {  // minimised: time stands still
        glfwWaitEventsTimeout(0.1);
        return true;
    }
    const bool last = options_.frames && shown_ + 1 >= *options_.frames;
    saves_ = saves_ || (last && !options_.screenshot.empty());
    drawPicture();
    interface_.begin();
    drawInterface();
    interface_.end();
    ++shown_;
    if (saves_) saveScreenshot();
    glfwSwapBuffers(window_);
    obey();
    return !last;
}

void WindowLoop::saveScreenshot() const {
    Image image{width_, height_, 4, std::vector<uint8_t>(size_t(width_) * size_t(height_) * 4)};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    turnOver(image);
    for (size_t i = 3; i < image.pixels.size(); i += 4)
        image.pixels[i] = 255;
    writePng(options_.screenshot, image);
    std::cout << "screenshot: " << printable(options_.screenshot) << "\n";
}

double WindowLoop::wallTime() {
    return glfwGetTime();
}

void WindowLoop::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void WindowLoop::entitle(const std::string& file, bool unsaved) {
    const std::string name = printable(std::filesystem::path(file).filename().string());
    glfwSetWindowTitle(window_, concat("Shoal - ", name, unsaved ? " *" : "").c_str());
}

}  // namespace shoal::window
