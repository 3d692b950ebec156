// The keyboard: which keys went down since the last look.
#pragma once

#include <map>

struct GLFWwindow;

namespace shoal::app {

class Keys {
  public:
    explicit Keys(GLFWwindow* window);

    // Once a frame, before pressed(). `heard`: else keys are someone else's, such as a text that is typed.
    void look(bool heard) { heard_ = heard; }
    // Went down since it was asked for last, by GLFW's number; also when it is up again by now.
    bool pressed(int key);
    bool control() const;  // is held

  private:
    GLFWwindow* window_;
    std::map<int, bool> down_;  // as seen last
    bool heard_ = true;
};

}  // namespace shoal::app
