// Rows of the editor: a label with a tip at the left, what is edited at the right, all in one column however
// deep they are; several numbers to drag are below their label. Each says whether the user changed it in this
// frame. Numbers stay within their limit, also when they are typed (Ctrl and a click); a line below the row
// says so of the number that was typed last.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {
struct Key;
}

namespace shoal::window {

constexpr double degrees = 57.29577951308232;  // of a radian

struct Limit {
    double least = 0, most = 1;
    const char* words = "a file may say";  // which limit it is
};

struct Row {
    const char* label;
    const char* tip;              // a short sentence
    const char* format = "%.2f";  // with the unit
    bool steep = false;           // logarithmic: small numbers have more room
    double scale = 1;             // what is shown is this times what is stored
    bool free = false;            // slideSpan: two numbers that do not push each other
    bool* says = nullptr;         // a box to tick before the value: whether there is one
};

// By its description: of a key whose name is one word, and all that it may say.
Row rowOf(const Key& key);
Limit limitOf(const Key& key);

// `reach`: of the slider, which a number that is typed may leave.
bool slide(const Row& row, const Limit& reach, const Limit& limit, double& value);
// Least and most, which push each other.
bool slideSpan(const Row& row, const Limit& reach, const Limit& limit, glm::dvec2& span);
bool drag(const Row& row, const Limit& limit, double* values, int count, double speed);
bool tick(const Row& row, bool& value);
bool type(const Row& row, std::string& text);  // changes when the user is done with it
// The index of the word that was chosen in this frame, which is another than `current`.
std::optional<size_t> choose(const Row& row, const std::string& current,
                             const std::vector<std::string>& words);
bool pickColor(const Row& row, const Limit& limit, glm::dvec3& color);  // of each channel

// Two sliders for a unit vector: above the horizon, and around from -z over +x. `angles` remembers them where
// the vector cannot (straight up); rad.
bool turnDirection(const char* tip, glm::dvec3& direction, glm::dvec2& angles);

// ---- Beside rows

void heading(const char* words);
bool toggle(const char* label, bool on);  // a button that looks pressed
// Shows a plain sentence, in lines of some 40 letters, while the pointer is on what was drawn last, whether
// or not that can be used now; with Shift held also the sentences behind it, such as a formula.
void tip(const std::string& words);
std::string plain(double number);             // four digits
std::string inWords(const std::string& key);  // "separationRadius" as "separation radius"

// Draws the label of a row and its box to tick; the widget that is drawn next takes the rest of it.
void beginRow(const Row& row);
void besideLabel();  // what is drawn next stands where the widgets of rows do

}  // namespace shoal::window
