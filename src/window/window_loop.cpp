#include "window/window_loop.h"

#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <utility>

#include "core/printable.h"
#include "gpu/gl.h"
#include "gpu/program.h"
#include "render/picture.h"
#include "run/signals.h"

namespace shoal::window {

static constexpr double early = 0.002;  // s, that a step may come before it is due

WindowLoop::WindowLoop(WindowOptions options, gpu::Context& context)
    : options_(std::move(options)),
      context_(context),
      window_(context.openWindow(options_.width, options_.height)) {
    context_.leave();
    glfwMakeContextCurrent(window_);
    // A late frame does not wait for the screen, where the driver can do that.
    const bool adapts = glfwExtensionSupported("GLX_EXT_swap_control_tear") == GLFW_TRUE;
    glfwSwapInterval(adapts ? -1 : 1);
    glfwGetFramebufferSize(window_, &width_, &height_);
    interface_.emplace(window_, options_.scale);
    glGenFramebuffers(1, &source_);
    glfwMakeContextCurrent(nullptr);
    context_.makeCurrent();
}

WindowLoop::~WindowLoop() {
    context_.leave();
    glfwMakeContextCurrent(window_);
    interface_.reset();
    glfwMakeContextCurrent(nullptr);
    glfwDestroyWindow(window_);
    context_.makeCurrent();
}

void WindowLoop::go() {
    ContextThread thread(context_);
    thread_ = &thread;
    glfwMakeContextCurrent(window_);
    auto last = std::chrono::steady_clock::now();
    while (!ends()) {
        awaitFrame();
        const auto time = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(time - last).count();
        lastSeconds_ = seconds - waited_;
        last = time;
        // the first intervals hold start-up, not frames
        if (shown_ > 1) frameSeconds_ += (seconds - frameSeconds_) * (shown_ == 2 ? 1 : 0.1);
        if (!showFrame()) break;
    }
    work([this] { leave(); });
}

void WindowLoop::awaitFrame() {
    constexpr double pause = 0.05;  // s, at the most, so that the window answers
    const double start = wallTime(), until = moves() > 0 ? std::min(next_ - early, start + pause) : 0;
    if (rests() && !interface_->input().waits())
        glfwWaitEventsTimeout(pause);
    else
        glfwPollEvents();
    for (double left;
         (left = until - wallTime()) > 0 && !glfwWindowShouldClose(window_) && !signalThatAsked();)
        glfwWaitEventsTimeout(left);
    waited_ = wallTime() - start;
}

bool WindowLoop::isDue() {
    const double time = wallTime(), rate = moves();
    if (rate <= 0 || time < next_ - early) return false;
    next_ = std::max(next_, time - early) + 1 / rate;  // what is late is not caught up
    return true;
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
    work([this] {
        if (presented_ != nullptr) {
            glWaitSync(presented_, 0, GL_TIMEOUT_IGNORED);
            glDeleteSync(std::exchange(presented_, nullptr));
        }
        drawPicture();
    });
    takePicture();
    presentPicture(width_, height_);
    presented_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    interface_->begin();
    thread_->begin([this] { drawInterface(); });
    thread_->finish();
    interface_->end();
    ++shown_;
    if (saves_) saveScreenshot();
    glfwSwapBuffers(window_);
    work([this] { obey(); });
    if (!title_.empty()) glfwSetWindowTitle(window_, std::exchange(title_, {}).c_str());
    if (std::exchange(closes_, false)) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    return !last;
}

// Does a part of the frame, and lets the window go on where that takes long.
void WindowLoop::work(std::function<void()> part) {
    constexpr std::chrono::milliseconds patience(500), pause(100);
    gpu::endFirstUse();  // of what went before
    thread_->begin(std::move(part));
    for (auto time = patience; !thread_->waits(time); time = pause) {
        glfwPollEvents();
        const Busy busy = busyWith();
        if (!busy.what.empty()) tellWaiting(busy);
    }
    thread_->finish();
}

void WindowLoop::tellWaiting(const Busy& busy) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    if (width < 1 || height < 1) return;
    presentPicture(width, height);
    const bool closes = glfwWindowShouldClose(window_) == GLFW_TRUE || signalThatAsked() != 0;
    interface_->wait(busy.what + (closes ? "; closing waits for that" : ""), busy.share);
    glfwSwapBuffers(window_);
}

void WindowLoop::show(const gpu::Texture& picture) {
    if (drawn_.drawn != nullptr) glDeleteSync(drawn_.drawn);
    drawn_ = {picture.id(), picture.width(), picture.height(), nullptr};
    drawn_.drawn = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    // A rasteriser draws for the other context without waiting for this one.
    context_.info().software ? glFinish() : glFlush();
}

// Takes what the thread of the scene has drawn, while that rests.
void WindowLoop::takePicture() {
    const GLuint texture = std::exchange(drawn_.texture, 0);
    if (texture == 0) return;
    glWaitSync(drawn_.drawn, 0, GL_TIMEOUT_IGNORED);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    sourceWidth_ = drawn_.width;
    sourceHeight_ = drawn_.height;
}

void WindowLoop::presentPicture(int width, int height) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glDisable(GL_SCISSOR_TEST);
    if (sourceWidth_ == 0) {
        glClearColor(0.1f, 0.13f, 0.12f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
    } else {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source_);
        const bool same = sourceWidth_ == width && sourceHeight_ == height;
        glBlitFramebuffer(0, 0, sourceWidth_, sourceHeight_, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                          same ? GL_NEAREST : GL_LINEAR);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    }
    glViewport(0, 0, width, height);
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

void WindowLoop::entitle(const std::string& file, bool unsaved) {
    const std::string name = printable(std::filesystem::path(file).filename().string());
    title_ = concat("Shoal - ", name, unsaved ? " *" : "");
}

}  // namespace shoal::window
