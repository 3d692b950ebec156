#include "app/keys.h"

#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>

#include <utility>

namespace shoal::app {

// By the window, not by ImGui, whose key codes changed their type in 1.89. A frame may take longer than a key
// is held: what was pressed stays so until somebody looks.
Keys::Keys(GLFWwindow* window) : window_(window) {
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE);
}

bool Keys::pressed(int key) {
    const bool down = glfwGetKey(window_, key) == GLFW_PRESS;
    const bool before = std::exchange(down_[key], down);
    return heard_ && down && !before;
}

bool Keys::control() const {
    return glfwGetKey(window_, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
           glfwGetKey(window_, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
}

}  // namespace shoal::app
