// A user of a real window, moved by xdotool while the program runs. Needs a display.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

namespace shoal::test {

inline bool hasXdotool() {
    static const bool has = std::system("command -v xdotool > /dev/null 2>&1") == 0;
    if (!has) std::cerr << "xdotool is not installed: what the user does in the window is not tested\n";
    return has;
}

// What a user does once the window is there, told by its title; places are in pixels of the window.
class User {
  public:
    explicit User(const std::string& title, const std::string& steps)
        : script_(
              "set -e\n"
              "for i in $(seq 300); do\n"
              "  w=$(xdotool search --onlyvisible --name '" +
              title +
              "' 2> /dev/null | head -n 1) && [ -n \"$w\" ] && break\n"
              "  sleep 0.1\ndone\n"
              "xdotool windowfocus $w; sleep 0.7\n"
              "at() { xdotool mousemove --window $w $1 $2; sleep 0.3; }\n"
              "press() { at $1 $2; xdotool mousedown 1; sleep 0.3; xdotool mouseup 1; sleep 0.25; }\n"
              "drag() { at $1 $2; xdotool mousedown 1; sleep 0.3; at $3 $2; at $3 $2; xdotool mouseup 1; "
              "sleep 0.25; }\n"
              "key() { xdotool keydown $1; sleep 0.3; xdotool keyup $1; sleep 0.3; }\n"
              "close() { for i in $(seq 40); do xdotool getwindowname $w > /dev/null 2>&1 || break; "
              "key Escape 2> /dev/null || break; done; }\n" +
              steps) {
        thread_ = std::thread([this] { code_ = std::system(("sh -c '" + quoted() + "'").c_str()); });
    }
    ~User() {
        if (thread_.joinable()) thread_.join();
    }
    int finish() {
        thread_.join();
        return WIFEXITED(code_) ? WEXITSTATUS(code_) : -1;
    }

  private:
    std::string quoted() const {
        std::string out;
        for (const char c : script_)
            out += c == '\'' ? std::string("'\\''") : std::string(1, c);
        return out;
    }

    std::string script_;
    int code_ = -1;
    std::thread thread_;
};

}  // namespace shoal::test
