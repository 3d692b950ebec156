#include "scene/read_fga.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/file.h"

namespace shoal {

namespace {

// Takes numbers off comma-separated text, counting lines and columns.
class NumberScanner {
  public:
    NumberScanner(const std::string& text, const std::string& file) : text_(text), file_(file) {
        if (text_.rfind("\xEF\xBB\xBF", 0) == 0) position_ = lineStart_ = 3;  // a byte order mark
    }

    // False at the end of the text. A number is followed by a comma, white space or the end.
    bool next(double& out) {
        skipSpace();
        begin_ = position_;
        beginLine_ = line_;
        beginLineStart_ = lineStart_;
        if (position_ == text_.size()) return false;
        size_t end = position_;
        while (end < text_.size() && text_[end] != ',' && !isSpace(text_[end]))
            ++end;
        out = convert(position_, end);
        position_ = end;
        skipSpace();
        if (position_ < text_.size() && text_[position_] == ',') ++position_;
        return true;
    }

    // Of the number taken last, or of the end.
    Location here() const { return {file_, beginLine_, static_cast<int>(begin_ - beginLineStart_) + 1, {}}; }

  private:
    static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

    void skipSpace() {
        for (; position_ < text_.size() && isSpace(text_[position_]); ++position_)
            if (text_[position_] == '\n') {
                ++line_;
                lineStart_ = position_ + 1;
            }
    }

    double convert(size_t begin, size_t end) const {
        const bool plus = begin < end && text_[begin] == '+';
        const char *first = text_.data() + begin + (plus ? 1 : 0), *last = text_.data() + end;
        double value = 0;
        const auto [stop, code] = std::from_chars(first, last, value);
        if (code == std::errc::result_out_of_range && stop == last)
            throw Error(here(),
                        concat("expected a number in the range of doubles, found ", quoted(begin, end)));
        if (code != std::errc() || stop != last)
            throw Error(here(), concat("expected a number, found ", quoted(begin, end)));
        if (!std::isfinite(value))
            throw Error(here(), concat("expected a finite number, found ", quoted(begin, end)));
        return value;
    }

    std::string quoted(size_t begin, size_t end) const {
        if (begin == end) return "\",\"";
        std::string out = text_.substr(begin, std::min<size_t>(end - begin, 24));
        for (char& c : out)
            if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
        return "\"" + out + (end - begin > 24 ? "...\"" : "\"");
    }

    const std::string& text_;
    const std::string& file_;
    size_t position_ = 0, lineStart_ = 0;
    int line_ = 1;
    size_t begin_ = 0, beginLineStart_ = 0;
    int beginLine_ = 1;
};

struct Header {
    glm::i64vec3 resolution{0};
    glm::dvec3 low{0}, high{0};
};

constexpr const char* axisNames[] = {"x", "y", "z"};

double need(NumberScanner& numbers, const std::string& what) {
    double value = 0;
    if (!numbers.next(value)) throw Error(numbers.here(), "expected " + what + ", found the end of the file");
    return value;
}

Header readHeader(NumberScanner& numbers) {
    Header header;
    long long cells = 1;
    for (int i = 0; i < 3; ++i) {
        const double count = need(numbers, concat("the resolution along ", axisNames[i]));
        if (!(count >= 1) || count != std::floor(count))
            throw Error(numbers.here(), concat("expected the resolution along ", axisNames[i],
                                               " as a whole number of at least 1, found ", count));
        // Each factor is checked before it is multiplied, so that the product cannot overflow.
        if (count > static_cast<double>(maxFieldCells) ||
            cells * static_cast<long long>(count) > maxFieldCells)
            throw Error(numbers.here(), concat("the resolution makes more than ", maxFieldCells,
                                               " cells (2^24), the most that a field may have"));
        header.resolution[i] = static_cast<long long>(count);
        cells *= header.resolution[i];
    }
    for (int i = 0; i < 3; ++i)
        header.low[i] = need(numbers, concat("the low bound along ", axisNames[i]));
    for (int i = 0; i < 3; ++i) {
        header.high[i] = need(numbers, concat("the high bound along ", axisNames[i]));
        if (!(header.low[i] < header.high[i]))
            throw Error(numbers.here(),
                        concat("expected the high bound along ", axisNames[i], " above the low one (",
                               header.low[i], "), found ", header.high[i]));
    }
    return header;
}

// Which of the file's axes each scene axis takes, and whether it runs the other way.
struct AxisMap {
    glm::ivec3 source{0, 1, 2};
    bool flipZ = false;

    template <typename V>
    V operator()(const V& v) const {
        V out(v[source.x], v[source.y], v[source.z]);
        if (flipZ) out.z = -out.z;
        return out;
    }
};

AxisMap axisMap(FieldAxes axes) {
    if (axes == FieldAxes::yUp) return {};
    return {{0, 2, 1}, axes == FieldAxes::zUp};
}

void setBounds(GridField& grid, const Header& header, const AxisMap& map, const FgaOptions& options,
               const std::string& file) {
    const glm::dvec3 a = map(header.low * options.scale) + options.origin;
    const glm::dvec3 b = map(header.high * options.scale) + options.origin;
    grid.low = glm::min(a, b);
    grid.high = glm::max(a, b);
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(grid.low[i]) < 1e30 && std::abs(grid.high[i]) < 1e30) || !(grid.low[i] < grid.high[i]))
            throw Error(Location{file, 0, 0, {}},
                        concat("bounds of ", grid.low[i], " to ", grid.high[i], " m along ", axisNames[i],
                               " after scaling are beyond single precision"));
}

}  // namespace

GridField parseFga(const std::string& text, const std::string& file, const FgaOptions& options) {
    NumberScanner numbers(text, file);
    const Header header = readHeader(numbers);
    const AxisMap map = axisMap(options.axes);
    GridField grid;
    grid.file = file;
    grid.wrap = options.wrap;
    grid.resolution = glm::ivec3(header.resolution[map.source.x], header.resolution[map.source.y],
                                 header.resolution[map.source.z]);
    setBounds(grid, header, map, options, file);

    const size_t cells = size_t(header.resolution.x * header.resolution.y * header.resolution.z);
    const size_t expected = 3 * cells;
    // A number and its separator take two characters at least: a short file cannot make us reserve much.
    if (text.size() / 2 + 1 < expected) {
        size_t found = 0;
        for (double ignored; numbers.next(ignored);)
            ++found;
        throw Error(numbers.here(), concat("expected ", expected, " values, found ", found));
    }

    const double scale = options.velocityScale.value_or(options.scale);
    grid.values.resize(cells);
    size_t found = 0;
    glm::ivec3 c;
    for (c.z = 0; c.z < header.resolution.z; ++c.z)
        for (c.y = 0; c.y < header.resolution.y; ++c.y)
            for (c.x = 0; c.x < header.resolution.x; ++c.x) {
                glm::dvec3 velocity(0);
                for (int i = 0; i < 3; ++i, ++found) {
                    if (!numbers.next(velocity[i]))
                        throw Error(numbers.here(), concat("expected ", expected, " values, found ", found));
                    velocity[i] *= scale;
                    if (!(std::abs(velocity[i]) < 1e30))
                        throw Error(numbers.here(), concat("a velocity of ", velocity[i],
                                                           " m/s after scaling is beyond single precision"));
                }
                glm::ivec3 cell(c[map.source.x], c[map.source.y], c[map.source.z]);
                if (map.flipZ) cell.z = grid.resolution.z - 1 - cell.z;
                const size_t index =
                    size_t(cell.x) +
                    size_t(grid.resolution.x) * (size_t(cell.y) + size_t(grid.resolution.y) * size_t(cell.z));
                grid.values[index] = glm::vec3(map(velocity));
            }
    if (double extra = 0; numbers.next(extra)) {
        const Location where = numbers.here();
        size_t count = found + 1;
        while (numbers.next(extra))
            ++count;
        throw Error(where, concat("expected ", expected, " values, found ", count));
    }
    return grid;
}

GridField readFga(const std::string& file, const FgaOptions& options) {
    return parseFga(readFile(file), file, options);
}

}  // namespace shoal
