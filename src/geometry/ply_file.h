// The content of a PLY file [Turk 1994]: its header, and row by row what its elements say, as text or as
// bytes of either order. For the reader of models of that name (read_ply.cpp) alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace shoal {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

size_t bytesOf(PlyType type);
// The number of this type that stands for 1 in shares such as colours.
double fullShare(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> countType;  // of a list; none: one number
};

struct PlyElement {
    std::string name;
    size_t count = 0;  // rows
    std::vector<PlyProperty> properties;
};

// One row of an element, by its properties.
struct PlyRow {
    std::vector<double> numbers;             // 0 for a list
    std::vector<std::vector<double>> lists;  // empty for a number
};

class PlyFile {
  public:
    // Reads the header. Error, located in it: a line that is none of PLY's, or no end.
    PlyFile(std::string bytes, const std::string& file);

    const std::vector<PlyElement>& elements() const { return elements_; }
    const std::vector<std::string>& comments() const { return comments_; }  // without the blanks around

    // Begins with the rows of the next element. Error: there is less left of the file than they take.
    void begin(const PlyElement& element);
    // Reads the next row of the element that was begun. Error: the file ends, or has something else there.
    void next(PlyRow& row);
    // How many bytes there are behind the last row, blanks in a text left out.
    size_t left();
    // An Error where the row that was read last begins.
    Error fail(const std::string& message) const;

  private:
    std::string_view headerLine();
    void readHeader();
    void addElement(const std::vector<std::string_view>& words);
    void addProperty(const std::vector<std::string_view>& words);
    double value(PlyType type);
    double written();
    double stored(PlyType type);
    size_t lengthOf(const PlyProperty& list);
    void skipBlanks();

    std::string bytes_;
    Location location_;
    size_t at_ = 0;  // the next byte
    bool text_ = true, swapped_ = false;
    std::string_view newline_;  // as the header has it
    std::vector<PlyElement> elements_;
    std::vector<std::string> comments_;
    const PlyElement* element_ = nullptr;
    size_t rows_ = 0, row_ = 0;      // how many were begun, and the last of them
    size_t rowLine_ = 0, line_ = 0;  // count from 1
};

}  // namespace shoal
