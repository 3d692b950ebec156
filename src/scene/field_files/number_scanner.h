// Takes numbers off text, separated by white space or commas, and knows where it is.
#pragma once

#include <string>

#include "core/error.h"

namespace shoal {

class NumberScanner {
  public:
    // All of the text; a byte order mark is skipped.
    NumberScanner(const std::string& text, const std::string& file);
    // A part of it, as text whose lines count from its beginning.
    NumberScanner(const std::string& text, size_t begin, size_t end, const std::string& file);

    // False at the end. A number is followed by a comma, white space or the end.
    // Error, located: not a number, not finite, beyond the range of doubles.
    bool next(double& out);

    // Returns the location of the number taken last, or of the end.
    Location here() const { return {*file_, beginLine_, static_cast<int>(begin_ - beginLineStart_) + 1, {}}; }

  private:
    void skipSpace();
    double convert(size_t begin, size_t end) const;
    std::string quoted(size_t begin, size_t end) const;

    const std::string* text_;
    const std::string* file_;
    size_t position_ = 0, lineStart_ = 0, end_ = 0;
    int line_ = 1;
    size_t begin_ = 0, beginLineStart_ = 0;
    int beginLine_ = 1;
};

// The line and column, from 1, of a byte of a text.
Location locate(const std::string& text, size_t position, const std::string& file);

}  // namespace shoal
