// ImGui's context and backends, for as long as the window lives, and how the panels look.
#pragma once

struct GLFWwindow;

namespace shoal::app {

class Interface {
  public:
    explicit Interface(GLFWwindow* window);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    void begin();  // of a frame
    void end();    // draws the panels over what is there
};

}  // namespace shoal::app
